// A camera that was calibrated by the horizon, as a scene.
#pragma once

#include <optional>
#include <string>

#include "fit/photo/photo_facts.h"
#include "fit/photo/pointing/horizon_calibration.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

struct HorizonCamera {
  std::string name;  ///< of the picture; empty: none
  fit::HorizonProblem problem;
  fit::HorizonCalibration found;
  std::string hfov_source;
  std::optional<sim::Camera> lens;  ///< if given by the user; `problem` is then that of a plain lens
  /// The effect of rounding the 35 mm equivalent focal length (half a millimetre) on the field of view in
  /// degrees, and on the elevation. It is not included in the error bars, which are those at the given field
  /// of view.
  std::optional<double> hfov_rounding_deg;
  double elevation_rounding_deg = 0.0;
  std::optional<double> azimuth_deg;  ///< given by the user
  std::optional<double> altitude_m;   ///< of the observer above the ground or sea that forms the horizon
  fit::PhotoFacts facts;              ///< of the picture
};

/// Returns [site] as far as it is known, and [camera], with error bars and sources as comments.
std::string horizon_toml(const HorizonCamera& camera);

}  // namespace vegard::apps
