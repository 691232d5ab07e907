// One lens for several pictures of a camera, each of which looks its own way: least squares over the stars of
// all of them, with the lens's numbers in common and three turns a picture.
//
// The lens is chosen as for one picture (lens_choice.h), from the fits of all. The residual of a star by a
// fit without it, or without its ninth of the picture, is (I - H_SS)^-1 r_S, with the residuals r_S of the
// set S that is left out and its block of the hat matrix.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/pointing/calibration.h"

namespace vegard::fit {

/// A picture with its stars, and the camera that it gives alone.
struct LensPicture {
  std::string name;
  SkyCamera camera;
  std::vector<StarSighting> stars;
  StarSet used;  ///< those that its own calibration uses
};

/// Returns the calibration of every picture, all with the same lens, in their order. `settings.start` and
/// `settings.only` are not used. Throws sim::Error(unreadable_input) about the picture that is mirrored while
/// the first is not, or about `name` if no lens fits.
std::vector<Calibration> calibrate_same_lens(const LensSettings& settings,
                                             const std::vector<LensPicture>& pictures, const Frame& frame,
                                             const std::string& name);

}  // namespace vegard::fit
