#include "fit/track/field_foot.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {
namespace field_foot_of {

GeodeticPlace geodetic(const Eigen::Vector3d& km) { return geodetic_place(EarthShape::wgs84, km); }

/// The direction of the field downwards, a unit vector, and whether it is along or against the field.
Eigen::Vector3d fall_at(const sim::Igrf& igrf, const Eigen::Vector3d& km, double sign) {
  const GeodeticPlace place = geodetic(km);
  const sim::FieldVector b = igrf.at(place.latitude_deg, place.longitude_deg, place.height_km);
  const double lat = place.latitude_deg * sim::kRadiansPerDegree,
               lon = place.longitude_deg * sim::kRadiansPerDegree;
  const double sl = std::sin(lat), cl = std::cos(lat), so = std::sin(lon), co = std::cos(lon);
  const double size = std::hypot(b.north_nt, b.east_nt, b.down_nt);
  const double n = sign * b.north_nt / size, e = sign * b.east_nt / size, d = sign * b.down_nt / size;
  return {-sl * co * n - so * e - cl * co * d, -sl * so * n + co * e - cl * so * d, cl * n - sl * d};
}

Eigen::Vector3d step(const sim::Igrf& igrf, const Eigen::Vector3d& from, double km, double sign) {
  const Eigen::Vector3d a = fall_at(igrf, from, sign), b = fall_at(igrf, from + 0.5 * km * a, sign),
                        c = fall_at(igrf, from + 0.5 * km * b, sign), d = fall_at(igrf, from + km * c, sign);
  return from + km / 6.0 * (a + 2.0 * (b + c) + d);
}

}  // namespace field_foot_of

GeodeticPlace place_of_state(const OrbitState& state, double utc_s) {
  using namespace field_foot_of;
  constexpr double kJulian1970 = 2440587.5, kDay_s = 86400.0;
  const double turned = sim::mean_sidereal_time_deg(kJulian1970 + utc_s / kDay_s) * sim::kRadiansPerDegree;
  const double c = std::cos(turned), s = std::sin(turned);
  return geodetic({c * state.km[0] + s * state.km[1], c * state.km[1] - s * state.km[0], state.km[2]});
}

std::optional<GeodeticPlace> field_foot(const sim::Igrf& igrf, const GeodeticPlace& from, double height_km) {
  using namespace field_foot_of;
  constexpr double kLongestKm = 1e5, kShareOfHeight = 0.05, kLeastStepKm = 1.0, kCloseKm = 1e-3;
  if (from.height_km < height_km) return std::nullopt;
  const sim::FieldVector here = igrf.at(from.latitude_deg, from.longitude_deg, from.height_km);
  const double sign = here.down_nt >= 0.0 ? 1.0 : -1.0;
  Eigen::Vector3d km = earth_place_km(EarthShape::wgs84, from);
  double gone = 0.0, above = from.height_km - height_km;
  while (above > kCloseKm && gone < kLongestKm) {
    const double long_step = std::max(kLeastStepKm, kShareOfHeight * (above + height_km));
    Eigen::Vector3d next = step(igrf, km, long_step, sign);
    double below = geodetic(next).height_km - height_km;
    double length = long_step;
    if (below < 0.0) {
      // The line is nearly straight over a step: the share of it that ends at the altitude, improved once.
      length *= above / (above - below);
      next = step(igrf, km, length, sign);
      below = geodetic(next).height_km - height_km;
      if (below < 0.0 && below > -kCloseKm) return geodetic(next);
      if (below < 0.0) {
        length *= above / (above - below);
        next = step(igrf, km, length, sign);
        return geodetic(next);
      }
    }
    km = next;
    gone += length;
    above = below;
  }
  if (above > kCloseKm) return std::nullopt;
  return geodetic(km);
}

}  // namespace vegard::fit
