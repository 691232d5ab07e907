#include "fit/border/border_distance.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {

double true_elevation_deg(double apparent_elevation_deg, double site_altitude_m) {
  // Pressure of the standard atmosphere (ICAO, to 11 km); higher there is no air to speak of.
  const double pressure_hpa =
      1010.0 * std::pow(std::max(0.0, 1.0 - 2.25577e-5 * std::max(0.0, site_altitude_m)), 5.25588);
  double elevation = apparent_elevation_deg;
  for (int i = 0; i < 30; ++i)
    elevation = apparent_elevation_deg - sim::refraction_deg(elevation, pressure_hpa);
  return elevation;
}

double ground_distance_km(double true_elevation_deg, double site_altitude_m, double altitude_km) {
  const double observer = sim::kEarthRadiusKm + 1e-3 * site_altitude_m;
  const double shell = sim::kEarthRadiusKm + altitude_km;
  if (observer >= shell) return sim::kNaN;
  const double zenith = (90.0 - true_elevation_deg) * sim::kRadiansPerDegree;
  // The line of sight must miss the ground: its closest approach to the Earth's centre.
  if (zenith > 0.5 * sim::kPi && observer * std::sin(zenith) < sim::kEarthRadiusKm) return sim::kNaN;
  const double there = std::asin(observer / shell * std::sin(zenith));
  return sim::kEarthRadiusKm * (zenith - there);
}

double elevation_of_place_deg(double ground_distance_km, double site_altitude_m, double altitude_km) {
  const double observer = sim::kEarthRadiusKm + 1e-3 * site_altitude_m;
  const double shell = sim::kEarthRadiusKm + altitude_km;
  const double angle = ground_distance_km / sim::kEarthRadiusKm;
  return std::atan2(shell * std::cos(angle) - observer, shell * std::sin(angle)) / sim::kRadiansPerDegree;
}

double latitude_of_place_deg(const sim::Site& site, double azimuth_deg, double ground_distance_km) {
  const double angle = ground_distance_km / sim::kEarthRadiusKm;
  const double latitude = site.latitude_deg * sim::kRadiansPerDegree;
  const double sine = std::sin(latitude) * std::cos(angle) +
                      std::cos(latitude) * std::sin(angle) * std::cos(azimuth_deg * sim::kRadiansPerDegree);
  return std::asin(std::clamp(sine, -1.0, 1.0)) / sim::kRadiansPerDegree;
}

BorderPlace border_place(const sim::Site& site, double azimuth_deg, double apparent_elevation_deg,
                         double elevation_error_deg, double altitude_km) {
  const auto distance = [&](double apparent) {
    return ground_distance_km(true_elevation_deg(apparent, site.altitude_m), site.altitude_m, altitude_km);
  };
  BorderPlace place;
  place.distance_km = distance(apparent_elevation_deg);
  const double step = 0.01;
  const double slope =
      (distance(apparent_elevation_deg + step) - distance(apparent_elevation_deg - step)) / (2.0 * step);
  place.distance_error_km = std::abs(slope) * elevation_error_deg;
  // The end of a great circle (Snyder 1987, USGS Professional Paper 1395, equations 5-5 and 5-6).
  const double angle = place.distance_km / sim::kEarthRadiusKm;
  const double latitude = site.latitude_deg * sim::kRadiansPerDegree;
  const double azimuth = azimuth_deg * sim::kRadiansPerDegree;
  place.latitude_deg = latitude_of_place_deg(site, azimuth_deg, place.distance_km);
  const double east = std::atan2(
      std::sin(angle) * std::sin(azimuth),
      std::cos(latitude) * std::cos(angle) - std::sin(latitude) * std::sin(angle) * std::cos(azimuth));
  place.longitude_deg = sim::wrapped_longitude_deg(site.longitude_deg + east / sim::kRadiansPerDegree);
  return place;
}

}  // namespace vegard::fit
