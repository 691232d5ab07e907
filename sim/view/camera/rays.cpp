#include "sim/view/camera/rays.h"

#include <cmath>
#include <limits>

#include "sim/base/number/constants.h"

namespace vegard::sim {
namespace {}  // namespace

double tangent_altitude_km(double observer_km, double elevation_deg) {
  if (!(elevation_deg < 0.0)) return kNaN;
  // H - (R + H) (1 - cos e), without the difference of two large numbers.
  const double sine = std::sin(0.5 * elevation_deg * kRadiansPerDegree);
  return observer_km - 2.0 * (kEarthRadiusKm + observer_km) * sine * sine;
}

double elevation_of_tangent_deg(double observer_km, double tangent_km) {
  const double below_km = observer_km - tangent_km;
  if (!(below_km >= 0.0 && tangent_km >= -kEarthRadiusKm)) return kNaN;
  return -2.0 * std::asin(std::sqrt(0.5 * below_km / (kEarthRadiusKm + observer_km))) / kRadiansPerDegree;
}

double tangent_distance_km(double observer_km, double elevation_deg) {
  if (!(elevation_deg < 0.0)) return kNaN;
  return (kEarthRadiusKm + observer_km) * std::sin(-elevation_deg * kRadiansPerDegree);
}

}  // namespace vegard::sim
