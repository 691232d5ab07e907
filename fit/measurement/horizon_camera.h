// A camera from points on the horizon of its picture: the stage that `vegard horizon` runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "fit/measurement/words.h"
#include "fit/photo/photo_facts.h"
#include "fit/photo/pointing/horizon_calibration.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct HorizonRequest {
  std::string photo,
      lens;  ///< files: the picture, and a camera whose lens is this picture's; both may be empty
  std::vector<PixelPoint> points;
  std::optional<PixelPoint> sky;  ///< a point above the horizon; left out: the picture's top is
  std::vector<int> size_px;       ///< width and height, in place of the picture's
  std::optional<double> hfov_deg, focal_35mm_mm, azimuth_deg;
  std::optional<double> altitude_m;  ///< of the observer above the ground or sea that forms the horizon
  double layer_km = 0.0, point_error_px = 1.0;
  double relief_deg = 0.0;  ///< HorizonProblem::relief_deg
  bool fit_hfov = false;    ///< the field of view is found, from a bent horizon
};

/// What the points say if one more number is found from them, or why they say nothing.
struct HorizonAlone {
  std::optional<HorizonCalibration> found;
  std::string problem;
  double layer_km = 0.0, layer_sigma_km = 0.0;  ///< of the limb, by the dip
};

struct HorizonCamera {
  std::string name;  ///< of the picture; empty: none
  HorizonProblem problem;
  HorizonCalibration found;
  std::string hfov_source;
  std::optional<sim::Camera> lens;  ///< if given by the user; `problem` is then that of a plain lens
  /// The effect of rounding the 35 mm equivalent focal length (half a millimetre) on the field of view in
  /// degrees, and on the elevation. It is not included in the error bars, which are those at the given field
  /// of view.
  std::optional<double> hfov_rounding_deg;
  double elevation_rounding_deg = 0.0;
  std::optional<double> azimuth_deg;  ///< given by the user
  std::optional<double> altitude_m;   ///< given by the user
  PhotoFacts facts;                   ///< of the picture
  /// With the dip found, and with the field of view found; only of horizons that bend.
  std::optional<HorizonAlone> by_points_alone, by_bending_alone;
};

/// Throws Error(usage) as calibrate_horizon() does and for a picture without a size or a lens that is not its
/// own; Error(unreadable_input).
HorizonCamera camera_by_horizon(const HorizonRequest& request);

/// "  camera.elevation_deg  12.34 ± 0.05", as tell_horizon() has it.
std::string elevation_line(const HorizonCamera& camera);

void tell_horizon(const HorizonCamera& camera, const Tell& tell);

/// The same numbers.
nlohmann::ordered_json horizon_json(const HorizonCamera& camera);

/// Returns [site] as far as it is known, and [camera], with error bars and sources as comments.
std::string horizon_toml(const HorizonCamera& camera);

}  // namespace vegard::fit
