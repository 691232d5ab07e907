// The border of which the headline of a measurement speaks: which of the traces, and where it is.
//
// Among the traces that are claimed to be aurora it is the most probable; probabilities that differ by less
// than a twentieth count as equal, and the longer and clearer trace comes first then. Its place is that of
// its nearest stretch, the five neighbouring points with the highest median elevation: the highest single
// point is too near by its noise.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "fit/border/border.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// The altitude that is assumed of a border whose altitude nobody measured; kBorderAltitudesKm are its
/// limits.
inline constexpr double kAssumedBorder_km = 105.0;

struct MainBorder {
  std::size_t trace = 0;                                ///< in Border::traces
  double from_azimuth_deg = 0.0, to_azimuth_deg = 0.0;  ///< of all of it, and its elevations
  double lowest_deg = 0.0, highest_deg = 0.0;
  double azimuth_deg = 0.0, elevation_deg = 0.0, elevation_error_deg = 0.0;  ///< of the nearest stretch
  double distance_km = 0.0;  ///< of the nearest stretch along the ground, kAssumedBorder_km high
  /// Standard error: the elevation's, and that of an altitude which may be any between the limits.
  double distance_error_km = 0.0;
  double lowest_distance_km = 0.0, highest_distance_km = 0.0;  ///< if it is as low, or as high, as the limits
  /// If the border is taken where the light has fallen to three quarters and to one quarter of its peak.
  double upper_level_km = 0.0, lower_level_km = 0.0;
  double latitude_deg = 0.0, longitude_deg = 0.0;
};

/// Where a trace with a measured border is; `pointing_error_deg` is a standard error that all of its
/// elevations share, beside their own.
MainBorder placed_border(const Border& border, std::size_t trace, const sim::Scene& scene,
                         double pointing_error_deg = 0.0);

/// Returns none if no claimed trace has a measured border.
std::optional<MainBorder> main_border(const Border& border, const sim::Scene& scene,
                                      double pointing_error_deg = 0.0);

/// The distance of the trace's border at this azimuth and its standard error, as above; NaN where it has no
/// measured point within two degrees.
struct DistanceAlong {
  double km = 0.0, error_km = 0.0;
};
DistanceAlong distance_along(const BorderTrace& trace, const sim::Scene& scene, double azimuth_deg);

/// What the traces that are not claimed look like: "4 like stars, 2 like a roof"; empty without any.
std::string unclaimed_words(const Border& border);

/// "north-east"
std::string compass_word(double azimuth_deg);

}  // namespace vegard::fit
