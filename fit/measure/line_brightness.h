// Converts a photograph's profile to the brightness of emission lines, if the sensor and its gain are known.
#pragma once

#include <string>
#include <vector>

#include "fit/measure/profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Indexed [(band * rows + row) * lines + line].
struct LineBrightness {
  std::vector<std::string> names;  ///< of the lines, wavelengths in tenths of a nanometre: "5577"
  std::vector<double> rayleigh;    ///< may be negative; NaN where a channel is unknown
  std::vector<double> sigma;       ///< from the profile's standard errors, channels assumed independent
  /// rayleigh^2, [((band * rows + row) * lines + line) * lines + other line]
  std::vector<double> covariance;
};

/// Subtracts the scene's sky and night sky from the profile and applies the inverse of the scene's
/// line_colours(). All other light (stars, moon, other lines) is wrongly attributed to the lines. Throws what
/// sim::LineEstimator and sim::SensorResponse throw.
LineBrightness line_brightness(const sim::Scene& scene, const Profile& profile);

}  // namespace vegard::fit
