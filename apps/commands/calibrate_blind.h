// `vegard calibrate --image PHOTO` without any camera to start from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/commands/calibrate_options.h"
#include "fit/photo/photo.h"
#include "fit/photo/pointing/sky_camera.h"

namespace vegard::apps {

struct BlindStars {
  int exit_code = 0;
  bool local = false;  ///< `stars` and `camera` are under the observer's sky; else all is done
  std::string table;   ///< of the recognised stars, for --stars-out; empty: none were
  std::vector<fit::StarSighting> stars;  ///< for the calibration
  fit::SkyCamera camera;
};

/// Recognises the stars and says what was found. Without time or site, or if the stars
/// stand below the horizon then, there is nothing to calibrate. `usable`: per pixel, or empty.
BlindStars recognise_blindly(const CalibrateOptions& options, const fit::Photo& photo,
                             const std::vector<char>& usable, const fit::SkyOfPicture& sky);

}  // namespace vegard::apps
