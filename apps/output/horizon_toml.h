// The camera that a horizon gives, as a scene.
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
  std::optional<sim::Camera> lens;  ///< given, with the picture's size; `problem` is then of a plain lens
  /// Half a millimetre of a rounded 35 mm equivalent, in degrees, and what it does to the elevation; no part
  /// of the error bars, which are those at the given field of view.
  std::optional<double> hfov_rounding_deg;
  double elevation_rounding_deg = 0.0;
  std::optional<double> azimuth_deg;  ///< given by the user
  std::optional<double> altitude_m;   ///< of the observer above what makes the horizon
  fit::PhotoFacts facts;              ///< of the picture
};

/// [site] as far as it is known, and [camera], with error bars and sources as comments.
std::string horizon_toml(const HorizonCamera& camera);

}  // namespace vegard::apps
