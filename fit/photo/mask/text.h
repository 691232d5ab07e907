// Finds captions in a picture: boxes around lines of letters.
#pragma once

#include <vector>

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

struct TextSettings {
  double contrast =
      0.25;         ///< least contrast of strokes to their surroundings, as a share of a display's range
  int letters = 5;  ///< least number of letters in a line
};

/// A line of text, with two pixels around it.
struct TextLine {
  int x_px, y_px, width_px, height_px;
  int letters;  ///< number of letters that were distinguished
};

/// Finds lines of bright letters. Strokes are what an opening by a square of seven pixels removes (from the
/// picture binned to at most 1500 pixels, in shown_brightness() of fit/photo/mask/plane.h). A letter is a
/// connected component of strokes, five to sixty pixels high, with an edge of at least 0.4 of its contrast
/// from one pixel to the next. A line consists of letters that follow each other within 1.2 letters' height,
/// overlap in height, and are alike in height (by a factor of two), colour (each channel within 0.15 of the
/// range) and contrast (by three tenths); two thirds of them end at one baseline (within a tenth of their
/// height, at least a pixel), and half fill less than 0.7 of their boxes. A row of stars or street lights is
/// therefore no line.
std::vector<TextLine> find_text(const Photo& photo, const TextSettings& settings = {});

/// Returns the pixels of the lines' boxes.
PixelSet boxes(const std::vector<TextLine>& lines, int width, int height);

}  // namespace vegard::fit
