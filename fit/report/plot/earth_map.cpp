#include "fit/report/plot/earth_map.h"

#include <cmath>

#include "sim/base/number/constants.h"

namespace vegard::fit {

GroundPoint ground_point(const double (&enu)[3]) {
  const double level = std::hypot(enu[0], enu[1]);
  if (level == 0.0) return {0.0, 0.0};
  const double distance = sim::kEarthRadiusKm * std::atan2(level, enu[2]);
  return {distance * enu[0] / level, distance * enu[1] / level};
}

GroundPoint ground_of_foot(sim::EastNorth foot_km) {
  constexpr double kRadius = sim::kEarthRadiusKm + sim::kFootAltitudeKm;
  return ground_point(
      {foot_km.east, foot_km.north,
       std::sqrt(kRadius * kRadius - foot_km.east * foot_km.east - foot_km.north * foot_km.north)});
}

GroundPoint ground_of_place(double latitude_deg, double place_latitude_deg, double longitude_from_deg) {
  const double here = latitude_deg * sim::kRadiansPerDegree,
               there = place_latitude_deg * sim::kRadiansPerDegree,
               longitude = longitude_from_deg * sim::kRadiansPerDegree;
  const double out = std::cos(there) * std::cos(longitude), pole = std::sin(there);
  return ground_point({std::cos(there) * std::sin(longitude), std::cos(here) * pole - std::sin(here) * out,
                       std::cos(here) * out + std::sin(here) * pole});
}

std::optional<GroundPoint> ground_of_sight(const LineOfSight& sight, double observer_altitude_km) {
  constexpr double kRadius = sim::kEarthRadiusKm + sim::kFootAltitudeKm;
  const double azimuth = sight.azimuth_deg * sim::kRadiansPerDegree,
               elevation = sight.elevation_deg * sim::kRadiansPerDegree;
  const double along[3] = {std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
                           std::sin(elevation)};
  const double from = sim::kEarthRadiusKm + observer_altitude_km;
  // |(0, 0, from) + t along| = radius has the roots -p -+ sqrt(p^2 + radius^2 - from^2).
  const double p = from * along[2];
  const auto half_chord2 = [&](double radius) { return p * p + radius * radius - from * from; };
  const double chord = half_chord2(kRadius);
  if (!(chord >= 0.0)) return {};
  const bool above = from > kRadius;
  if (p < 0.0 && !above && half_chord2(sim::kEarthRadiusKm) > 0.0) return {};
  const double t = above ? -p - std::sqrt(chord) : -p + std::sqrt(chord);
  if (!(t > 0.0)) return {};
  return ground_point({t * along[0], t * along[1], from + t * along[2]});
}

}  // namespace vegard::fit
