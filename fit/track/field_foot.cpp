#include "fit/track/field_foot.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/wgs84.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {
namespace field_foot_of {

constexpr double kEquatorKm = sim::kWgs84EquatorKm, kFlattening = sim::kWgs84Flattening,
                 kSquare = sim::kWgs84SquareEccentricity;

double across(double sine) { return sim::wgs84_normal_km(sine); }

/// The direction of the field downwards, a unit vector, and whether it is along or against the field.
EarthFixed fall_at(const sim::Igrf& igrf, const EarthFixed& km, double sign) {
  const SatellitePlace place = geodetic(km);
  const sim::FieldVector b = igrf.at(place.latitude_deg, place.longitude_deg, place.altitude_km);
  const double lat = place.latitude_deg * sim::kRadiansPerDegree,
               lon = place.longitude_deg * sim::kRadiansPerDegree;
  const double sl = std::sin(lat), cl = std::cos(lat), so = std::sin(lon), co = std::cos(lon);
  const double size = std::hypot(b.north_nt, b.east_nt, b.down_nt);
  const double n = sign * b.north_nt / size, e = sign * b.east_nt / size, d = sign * b.down_nt / size;
  return {-sl * co * n - so * e - cl * co * d, -sl * so * n + co * e - cl * so * d, cl * n - sl * d};
}

EarthFixed moved(const EarthFixed& from, const EarthFixed& along, double km) {
  return {from[0] + km * along[0], from[1] + km * along[1], from[2] + km * along[2]};
}

EarthFixed step(const sim::Igrf& igrf, const EarthFixed& from, double km, double sign) {
  const EarthFixed a = fall_at(igrf, from, sign), b = fall_at(igrf, moved(from, a, 0.5 * km), sign),
                   c = fall_at(igrf, moved(from, b, 0.5 * km), sign),
                   d = fall_at(igrf, moved(from, c, km), sign);
  EarthFixed mean{};
  for (std::size_t i = 0; i < 3; ++i) mean[i] = (a[i] + 2.0 * (b[i] + c[i]) + d[i]) / 6.0;
  return moved(from, mean, km);
}

}  // namespace field_foot_of

EarthFixed earth_fixed(const SatellitePlace& place) {
  using namespace field_foot_of;
  const double lat = place.latitude_deg * sim::kRadiansPerDegree,
               lon = place.longitude_deg * sim::kRadiansPerDegree, sine = std::sin(lat);
  const double n = across(sine), r = (n + place.altitude_km) * std::cos(lat);
  return {r * std::cos(lon), r * std::sin(lon), (n * (1.0 - kSquare) + place.altitude_km) * sine};
}

SatellitePlace geodetic(const EarthFixed& km) {
  using namespace field_foot_of;
  const double r = std::hypot(km[0], km[1]);
  constexpr int kTurns = 5;
  double lat = std::atan2(km[2], r * (1.0 - kSquare));
  for (int i = 0; i < kTurns; ++i) {
    // By the reduced latitude, which converges everywhere outside of the Earth's core.
    const double reduced = std::atan2((1.0 - kFlattening) * std::sin(lat), std::cos(lat));
    const double s = std::sin(reduced), c = std::cos(reduced), polar = kEquatorKm * (1.0 - kFlattening);
    lat = std::atan2(km[2] + kSquare / (1.0 - kSquare) * polar * s * s * s,
                     r - kSquare * kEquatorKm * c * c * c);
  }
  const double sine = std::sin(lat), cosine = std::cos(lat);
  // The distance along the normal, well conditioned at the poles too.
  const double altitude = r * cosine + km[2] * sine - kEquatorKm * kEquatorKm / across(sine);
  return {lat / sim::kRadiansPerDegree, std::atan2(km[1], km[0]) / sim::kRadiansPerDegree, altitude};
}

SatellitePlace place_of_state(const OrbitState& state, double utc_s) {
  constexpr double kJulian1970 = 2440587.5, kDay_s = 86400.0;
  const double turned = sim::mean_sidereal_time_deg(kJulian1970 + utc_s / kDay_s) * sim::kRadiansPerDegree;
  const double c = std::cos(turned), s = std::sin(turned);
  return geodetic({c * state.km[0] + s * state.km[1], c * state.km[1] - s * state.km[0], state.km[2]});
}

std::optional<SatellitePlace> field_foot(const sim::Igrf& igrf, const SatellitePlace& from,
                                         double altitude_km) {
  using namespace field_foot_of;
  constexpr double kLongestKm = 1e5, kShareOfHeight = 0.05, kLeastStepKm = 1.0, kCloseKm = 1e-3;
  if (from.altitude_km < altitude_km) return std::nullopt;
  const sim::FieldVector here = igrf.at(from.latitude_deg, from.longitude_deg, from.altitude_km);
  const double sign = here.down_nt >= 0.0 ? 1.0 : -1.0;
  EarthFixed km = earth_fixed(from);
  double gone = 0.0, height = from.altitude_km - altitude_km;
  while (height > kCloseKm && gone < kLongestKm) {
    const double long_step = std::max(kLeastStepKm, kShareOfHeight * (height + altitude_km));
    EarthFixed next = step(igrf, km, long_step, sign);
    double below = geodetic(next).altitude_km - altitude_km;
    double length = long_step;
    if (below < 0.0) {
      // The line is nearly straight over a step: the share of it that ends at the altitude, improved once.
      length *= height / (height - below);
      next = step(igrf, km, length, sign);
      below = geodetic(next).altitude_km - altitude_km;
      if (below < 0.0 && below > -kCloseKm) return geodetic(next);
      if (below < 0.0) {
        length *= height / (height - below);
        next = step(igrf, km, length, sign);
        return geodetic(next);
      }
    }
    km = next;
    gone += length;
    height = below;
  }
  if (height > kCloseKm) return std::nullopt;
  return geodetic(km);
}

}  // namespace vegard::fit
