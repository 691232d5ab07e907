// Captions burnt into a picture: boxes about lines of letters.
#pragma once

#include <vector>

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

struct TextSettings {
  double contrast = 0.25;  ///< how far strokes stand out of what is around them, of a display's range
  int letters = 5;         ///< the fewest in a line
};

/// A line of text, with two pixels around it.
struct TextLine {
  int x_px, y_px, width_px, height_px;
  int letters;  ///< that were distinguished
};

/// Bright letters only. Strokes are what an opening by a square of seven pixels takes away (of the picture
/// binned to at most 1500 pixels, in brightness as on a display, fit/photo/mask/plane.h); a letter is strokes
/// that are connected, five to sixty pixels high, with an edge as steep as 0.4 of their contrast from one
/// pixel to the next. A line is letters that follow each other within 1.2 letters' height, overlap in height,
/// are alike in height (by a factor of two), colour (each channel within 0.15 of the range) and contrast (by
/// three tenths), of which two thirds end at one baseline (within a tenth of their height, at least a pixel)
/// and half fill less than 0.7 of their boxes with ink. That makes a row of stars or street lights none.
std::vector<TextLine> find_text(const Photo& photo, const TextSettings& settings = {});

PixelSet boxes(const std::vector<TextLine>& lines, int width, int height);

}  // namespace vegard::fit
