// The stars of a picture recognised blindly: found at the scale at which they are points, then recognised.
//
// A star of a large photograph is many pixels wide, and the finder's weight is 1.2 px: the picture is looked
// at as it is and made smaller by whole numbers, until the stars are recognised.
#pragma once

#include <vector>

#include "fit/photo/pointing/blind/star_recognition.h"
#include "sim/base/image.h"

namespace vegard::fit {

struct PictureStars {
  StarRecognition recognition;   ///< of the first scale that was certain, else of the best
  std::vector<FoundStar> found;  ///< all points at that scale, in the picture's own pixels
  int smaller = 1;               ///< by how much the picture was made smaller
};

/// As find_stars() takes them.
PictureStars recognise_picture(const sim::Image& linear, const StarFinderSettings& finder = {},
                               const std::vector<char>& usable = {},
                               const RecognitionSettings& settings = {});

}  // namespace vegard::fit
