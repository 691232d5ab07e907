// A photograph's profile as the brightness of its lines, where the sensor and its gain are known.
#pragma once

#include <string>
#include <vector>

#include "fit/measure/profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Indexed [(band * rows + row) * lines + line].
struct LineBrightness {
  std::vector<std::string> names;  ///< of the lines, wavelengths in tenths of a nanometre: "5577"
  std::vector<double> rayleigh;    ///< signed; NaN where a channel is unknown
  std::vector<double> sigma;       ///< from the profile's standard errors, channels taken as independent
  /// rayleigh^2, [((band * rows + row) * lines + line) * lines + other line]
  std::vector<double> covariance;
};

/// The profile less the scene's sky and night sky, through the inverse of the scene's line_colours(). What
/// else shines (stars, moon, other lines) is not known to it and ends up in the lines. Throws what
/// sim::LineEstimator and sim::SensorResponse throw.
LineBrightness line_brightness(const sim::Scene& scene, const Profile& profile);

}  // namespace vegard::fit
