#include "sim/view/sky/planets.h"

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/vec3.h"
#include "sim/view/sky/star_place.h"

namespace vegard::sim {
namespace {

constexpr double kLightDaysPerAu = 0.0057755183;
constexpr double kObliquityJ2000_deg = 23.43928;  // Standish's own

/// The northern pole of Saturn's rings, J2000 (IAU).
constexpr double kRingPoleRa_deg = 40.589, kRingPoleDec_deg = 83.537;

/// Orbital elements at J2000 and their changes in a century: astronomical units and degrees.
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
     -23.94362959, 0.44441088, 49.55953891, -0.29257343}};

constexpr Elements kEarth = {1.00000261,   0.00000562,  0.01671123,   -0.00004392,
                             -0.00001531,  -0.01294668, 100.46457166, 35999.37244981,
                             102.93768193, 0.32327364,  0.0,          0.0};

/// Returns the place from the Sun, in astronomical units, ecliptic and equinox J2000.
Vec3<double> heliocentric(const Elements& elements, double julian_date) {
  const double t = (julian_date - kJ2000) / kDaysPerCentury;
  const double axis = elements.axis + elements.axis_rate * t,
               e = elements.eccentricity + elements.eccentricity_rate * t;
  const double inclination = (elements.inclination + elements.inclination_rate * t) * kRadiansPerDegree;
  const double perihelion = elements.perihelion + elements.perihelion_rate * t,
               node_deg = elements.node + elements.node_rate * t;
  const double mean = std::remainder(elements.longitude + elements.longitude_rate * t - perihelion, 360.0) *
                      kRadiansPerDegree;
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

/// Orbital elements of date as linear functions of the days since 1999 December 31, 0 h.
struct GiantElements {
  double node, node_rate, inclination, inclination_rate, perihelion, perihelion_rate, axis, eccentricity,
      eccentricity_rate, anomaly, anomaly_rate;
};
constexpr GiantElements kJupiter = {100.4542, 2.76854e-5, 1.3030,   -1.557e-7, 273.8777,    1.64505e-5,
                                    5.20256,  0.048498,   4.469e-9, 19.8950,   0.0830853001};
constexpr GiantElements kSaturn = {113.6634, 2.38980e-5, 2.4886,    -1.081e-7, 339.3939,    2.97661e-5,
                                   9.55475,  0.055546,   -9.499e-9, 316.9670,  0.0334442282};

/// Returns the heliocentric place of Jupiter or Saturn, which perturb each other.
Vec3<double> heliocentric_giant(Planet planet, double julian_date) {
  constexpr double kFirstDay = 2451543.5, kPrecession_deg_per_day = 3.82394e-5;
  const double days = julian_date - kFirstDay;
  const auto sine_of = [](double degrees) {
    return std::sin(std::remainder(degrees, 360.0) * kRadiansPerDegree);
  };
  const auto cosine_of = [](double degrees) {
    return std::cos(std::remainder(degrees, 360.0) * kRadiansPerDegree);
  };
  const GiantElements& elements = planet == Planet::jupiter ? kJupiter : kSaturn;
  const double e = elements.eccentricity + elements.eccentricity_rate * days;
  const double mean =
      std::remainder(elements.anomaly + elements.anomaly_rate * days, 360.0) * kRadiansPerDegree;
  double anomaly = mean;
  for (int i = 0; i < 8; ++i)
    anomaly -= (anomaly - e * std::sin(anomaly) - mean) / (1.0 - e * std::cos(anomaly));
  const double x = elements.axis * (std::cos(anomaly) - e),
               y = elements.axis * std::sqrt(1.0 - e * e) * std::sin(anomaly);
  const double distance = std::hypot(x, y);
  const double along =
      std::atan2(y, x) / kRadiansPerDegree + elements.perihelion + elements.perihelion_rate * days;
  const double node = elements.node + elements.node_rate * days,
               inclination = elements.inclination + elements.inclination_rate * days;
  const double across = sine_of(along) * cosine_of(inclination);
  double longitude = node + std::atan2(across, cosine_of(along)) / kRadiansPerDegree;
  double latitude = std::asin(sine_of(along) * sine_of(inclination)) / kRadiansPerDegree;
  const double j = kJupiter.anomaly + kJupiter.anomaly_rate * days,
               s = kSaturn.anomaly + kSaturn.anomaly_rate * days;
  if (planet == Planet::jupiter) {
    longitude += -0.332 * sine_of(2.0 * j - 5.0 * s - 67.6) - 0.056 * sine_of(2.0 * j - 2.0 * s + 21.0) +
                 0.042 * sine_of(3.0 * j - 5.0 * s + 21.0) - 0.036 * sine_of(j - 2.0 * s) +
                 0.022 * cosine_of(j - s) + 0.023 * sine_of(2.0 * j - 3.0 * s + 52.0) -
                 0.016 * sine_of(j - 5.0 * s - 69.0);
  } else {
    longitude += 0.812 * sine_of(2.0 * j - 5.0 * s - 67.6) - 0.229 * cosine_of(2.0 * j - 4.0 * s - 2.0) +
                 0.119 * sine_of(j - 2.0 * s - 3.0) + 0.046 * sine_of(2.0 * j - 6.0 * s - 69.0) +
                 0.014 * sine_of(j - 3.0 * s + 32.0);
    latitude += -0.020 * cosine_of(2.0 * j - 4.0 * s - 2.0) + 0.018 * sine_of(2.0 * j - 6.0 * s - 49.0);
  }
  longitude -= kPrecession_deg_per_day * (julian_date - kJ2000);
  return {distance * cosine_of(longitude) * cosine_of(latitude),
          distance * sine_of(longitude) * cosine_of(latitude), distance * sine_of(latitude)};
}

Equatorial equatorial_of(const Vec3<double>& ecliptic) {
  const double c = std::cos(kObliquityJ2000_deg * kRadiansPerDegree),
               s = std::sin(kObliquityJ2000_deg * kRadiansPerDegree);
  const double y = c * ecliptic[1] - s * ecliptic[2], z = s * ecliptic[1] + c * ecliptic[2];
  double a = std::atan2(y, ecliptic[0]) / kRadiansPerDegree;
  if (a < 0.0) a += 360.0;
  return {a, std::atan2(z, std::hypot(ecliptic[0], y)) / kRadiansPerDegree};
}

/// A planet as the Earth sees it, in astronomical units, ecliptic and equinox J2000.
struct PlanetSight {
  Vec3<double> from_sun, from_earth;
};

PlanetSight planet_sight(Planet planet, double julian_date) {
  const Vec3<double> earth = heliocentric(kEarth, julian_date);
  double light_days = 0.0;
  PlanetSight sight{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  for (int i = 0; i < 3; ++i) {
    const double then = julian_date - light_days;
    sight.from_sun = planet == Planet::jupiter || planet == Planet::saturn
                         ? heliocentric_giant(planet, then)
                         : heliocentric(kElements[static_cast<int>(planet)], then);
    for (int k = 0; k < 3; ++k) sight.from_earth[k] = sight.from_sun[k] - earth[k];
    light_days = kLightDaysPerAu * std::sqrt(dot3(sight.from_earth, sight.from_earth));
  }
  return sight;
}

}  // namespace

const char* name_of(Planet planet) {
  constexpr const char* kNames[] = {"Mercury", "Venus", "Mars", "Jupiter", "Saturn"};
  return kNames[static_cast<int>(planet)];
}

Equatorial place_of_planet(Planet planet, double julian_date) {
  return equatorial_of(planet_sight(planet, julian_date).from_earth);
}

PlanetLight light_of_planet(Planet planet, double julian_date) {
  const PlanetSight sight = planet_sight(planet, julian_date);
  const double from_sun = std::sqrt(dot3(sight.from_sun, sight.from_sun)),
               from_earth = std::sqrt(dot3(sight.from_earth, sight.from_earth));
  const double i = std::acos(dot3(sight.from_sun, sight.from_earth) / (from_sun * from_earth)) /
                   kRadiansPerDegree;  // the phase angle
  const double by_distance = 5.0 * std::log10(from_sun * from_earth);
  switch (planet) {
    case Planet::mercury:
      return {-0.42 + by_distance + i * (0.0380 + i * (-0.000273 + i * 0.000002)), 0.93};
    case Planet::venus:
      return {-4.40 + by_distance + i * (0.0009 + i * (0.000239 - i * 0.00000065)), 0.82};
    case Planet::mars:
      return {-1.52 + by_distance + 0.016 * i, 1.36};
    case Planet::jupiter:
      return {-9.40 + by_distance + 0.005 * i, 0.83};
    case Planet::saturn:
      break;
  }
  // The rings' northern pole, and how far the Earth and the Sun stand from their plane.
  const Equatorial at = equatorial_of(sight.from_earth);
  const double pole_tilt =
      std::abs(std::cos(separation_deg({kRingPoleRa_deg, kRingPoleDec_deg}, at) * kRadiansPerDegree));
  return {-8.88 + by_distance + 0.044 * i + pole_tilt * (-2.60 + 1.25 * pole_tilt), 1.04};
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
