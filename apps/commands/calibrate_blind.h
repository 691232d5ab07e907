// `vegard calibrate --image PHOTO` without a camera to start from: recognises the stars.
#pragma once

#include <string>
#include <vector>

#include "apps/commands/calibrate_options.h"
#include "fit/photo/photo.h"
#include "fit/photo/pointing/sky_camera.h"

namespace vegard::apps {

struct BlindStars {
  int exit_code = 0;
  bool local = false;  ///< whether `stars` and `camera` are in the observer's horizontal frame; else the
                       ///< command is finished
  std::string table;   ///< table of the recognised stars, for --stars-out; empty if there are none
  std::vector<fit::StarSighting> stars;  ///< for the calibration
  fit::SkyCamera camera;
};

/// Recognises the stars and prints the result. Without time or site, or if the stars were below the horizon
/// at that time, a calibration is not possible. `usable` is per pixel, or empty.
BlindStars recognise_blindly(const CalibrateOptions& options, const fit::Photo& photo,
                             const std::vector<char>& usable, const fit::SkyOfPicture& sky);

}  // namespace vegard::apps
