#include "sim/view/sky/planets.h"

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/vec3.h"
#include "sim/view/sky/instant.h"

namespace vegard::sim {
namespace {

constexpr double kLightDaysPerAu = 0.0057755183;
constexpr double kObliquityJ2000_deg = 23.43928;  // Standish's own

/// At J2000 and the change in a century: astronomical units and degrees.
struct Elements {
  double axis, axis_rate, eccentricity, eccentricity_rate, inclination, inclination_rate, longitude,
      longitude_rate, perihelion, perihelion_rate, node, node_rate;
};

constexpr Elements kElements[] = {
    {0.38709927, 0.00000037, 0.20563593, 0.00001906, 7.00497902, -0.00594749, 252.25032350, 149472.67411175,
     77.45779628, 0.16047689, 48.33076593, -0.12534081},
    {0.72333566, 0.00000390, 0.00677672, -0.00004107, 3.39467605, -0.00078890, 181.97909950, 58517.81538729,
     131.60246718, 0.00268329, 76.67984255, -0.27769418},
    {1.52371034, 0.00001847, 0.09339410, 0.00007882, 1.84969142, -0.00813131, -4.55343205, 19140.30268499,
     -23.94362959, 0.44441088, 49.55953891, -0.29257343},
    {5.20288700, -0.00011607, 0.04838624, -0.00013253, 1.30439695, -0.00183714, 34.39644051, 3034.74612775,
     14.72847983, 0.21252668, 100.47390909, 0.20469106},
    {9.53667594, -0.00125060, 0.05386179, -0.00050991, 2.48599187, 0.00193609, 49.95424423, 1222.49362201,
     92.59887831, -0.41897216, 113.66242448, -0.28867794}};

constexpr Elements kEarth = {1.00000261,   0.00000562,  0.01671123,   -0.00004392,
                             -0.00001531,  -0.01294668, 100.46457166, 35999.37244981,
                             102.93768193, 0.32327364,  0.0,          0.0};

/// From the Sun, in astronomical units, ecliptic and equinox J2000.
Vec3<double> heliocentric(const Elements& of, double julian_date) {
  const double t = (julian_date - kJ2000) / kDaysPerCentury;
  const double axis = of.axis + of.axis_rate * t, e = of.eccentricity + of.eccentricity_rate * t;
  const double inclination = (of.inclination + of.inclination_rate * t) * kRadiansPerDegree;
  const double perihelion = of.perihelion + of.perihelion_rate * t, node_deg = of.node + of.node_rate * t;
  const double mean =
      std::remainder(of.longitude + of.longitude_rate * t - perihelion, 360.0) * kRadiansPerDegree;
  // Kepler's equation by Newton's method: e is 0.21 at most.
  double anomaly = mean + e * std::sin(mean);
  for (int i = 0; i < 8; ++i)
    anomaly -= (anomaly - e * std::sin(anomaly) - mean) / (1.0 - e * std::cos(anomaly));
  const double x = axis * (std::cos(anomaly) - e), y = axis * std::sqrt(1.0 - e * e) * std::sin(anomaly);
  const double argument = (perihelion - node_deg) * kRadiansPerDegree, node = node_deg * kRadiansPerDegree;
  const double along = x * std::cos(argument) - y * std::sin(argument);
  const double across = x * std::sin(argument) + y * std::cos(argument);
  return {along * std::cos(node) - across * std::cos(inclination) * std::sin(node),
          along * std::sin(node) + across * std::cos(inclination) * std::cos(node),
          across * std::sin(inclination)};
}

Equatorial equatorial_of(const Vec3<double>& ecliptic) {
  const double c = std::cos(kObliquityJ2000_deg * kRadiansPerDegree),
               s = std::sin(kObliquityJ2000_deg * kRadiansPerDegree);
  const double y = c * ecliptic[1] - s * ecliptic[2], z = s * ecliptic[1] + c * ecliptic[2];
  double a = std::atan2(y, ecliptic[0]) / kRadiansPerDegree;
  if (a < 0.0) a += 360.0;
  return {a, std::atan2(z, std::hypot(ecliptic[0], y)) / kRadiansPerDegree};
}

}  // namespace

const char* name_of(Planet planet) {
  constexpr const char* kNames[] = {"Mercury", "Venus", "Mars", "Jupiter", "Saturn"};
  return kNames[static_cast<int>(planet)];
}

Equatorial place_of_planet(Planet planet, double julian_date) {
  const Vec3<double> earth = heliocentric(kEarth, julian_date);
  double light_days = 0.0;
  Vec3<double> seen{0.0, 0.0, 0.0};
  for (int i = 0; i < 3; ++i) {
    const Vec3<double> there = heliocentric(kElements[static_cast<int>(planet)], julian_date - light_days);
    seen = {there[0] - earth[0], there[1] - earth[1], there[2] - earth[2]};
    light_days = kLightDaysPerAu * std::sqrt(seen[0] * seen[0] + seen[1] * seen[1] + seen[2] * seen[2]);
  }
  return equatorial_of(seen);
}

Equatorial place_of_sun(double julian_date) {
  const Vec3<double> earth = heliocentric(kEarth, julian_date);
  return equatorial_of({-earth[0], -earth[1], -earth[2]});
}

double separation_deg(const Equatorial& one, const Equatorial& other) {
  const double d1 = one.declination_deg * kRadiansPerDegree, d2 = other.declination_deg * kRadiansPerDegree;
  const double a = (other.right_ascension_deg - one.right_ascension_deg) * kRadiansPerDegree;
  const double across = std::hypot(std::cos(d2) * std::sin(a),
                                   std::cos(d1) * std::sin(d2) - std::sin(d1) * std::cos(d2) * std::cos(a));
  const double along = std::sin(d1) * std::sin(d2) + std::cos(d1) * std::cos(d2) * std::cos(a);
  return std::atan2(across, along) / kRadiansPerDegree;
}

}  // namespace vegard::sim
