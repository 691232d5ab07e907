// Finds and recognises the stars of a picture of which nothing is known, at the scale at which they are
// points.
//
// In a large photograph a star is many pixels wide, but the finder's weight has a width of 1.2 px: the
// picture is reduced by one integer factor after another, from 1 on, until the stars are recognised.
#pragma once

#include <vector>

#include "fit/photo/pointing/blind/star_recognition.h"
#include "sim/base/image.h"

namespace vegard::fit {

struct PictureStars {
  StarRecognition recognition;   ///< that of the first certain scale, or of the best
  std::vector<FoundStar> found;  ///< all points at that scale, in the picture's own pixels
  int smaller = 1;               ///< the factor by which the picture was reduced
};

/// Recognises the stars; `linear`, `finder` and `usable` as for find_stars().
PictureStars recognise_picture(const sim::Image& linear, const StarFinderSettings& finder = {},
                               const std::vector<char>& usable = {},
                               const RecognitionSettings& settings = {});

}  // namespace vegard::fit
