#include "sim/view/sky/moon.h"

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/view/sky/instant.h"
#include "sim/view/sky/planets.h"

namespace vegard::sim {
namespace {

/// Of an angle in degrees that has turned many times.
double sin_deg(double degrees) { return std::sin(std::remainder(degrees, 360.0) * kRadiansPerDegree); }
double cos_deg(double degrees) { return std::cos(std::remainder(degrees, 360.0) * kRadiansPerDegree); }

/// A multiple of each argument, and millionths of a degree, or metres.
struct MoonTerm {
  int elongation, sun, moon, node;
  double size;
};

constexpr MoonTerm kMoonLongitude[] = {
    {0, 0, 1, 0, 6288774.0}, {2, 0, -1, 0, 1274027.0}, {2, 0, 0, 0, 658314.0},  {0, 0, 2, 0, 213618.0},
    {0, 1, 0, 0, -185116.0}, {0, 0, 0, 2, -114332.0},  {2, 0, -2, 0, 58793.0},  {2, -1, -1, 0, 57066.0},
    {2, 0, 1, 0, 53322.0},   {2, -1, 0, 0, 45758.0},   {0, 1, -1, 0, -40923.0}, {1, 0, 0, 0, -34720.0},
    {0, 1, 1, 0, -30383.0},  {2, 0, 0, -2, 15327.0},   {0, 0, 1, 2, -12528.0},  {0, 0, 1, -2, 10980.0},
    {4, 0, -1, 0, 10675.0},  {0, 0, 3, 0, 10034.0},    {4, 0, -2, 0, 8548.0},   {2, 1, -1, 0, -7888.0},
    {2, 1, 0, 0, -6766.0},   {1, 0, -1, 0, -5163.0},   {1, 1, 0, 0, 4987.0},    {2, -1, 1, 0, 4036.0},
    {2, 0, 2, 0, 3994.0},    {4, 0, 0, 0, 3861.0},     {2, 0, -3, 0, 3665.0}};

constexpr MoonTerm kMoonLatitude[] = {
    {0, 0, 0, 1, 5128122.0}, {0, 0, 1, 1, 280602.0},  {0, 0, 1, -1, 277693.0}, {2, 0, 0, -1, 173237.0},
    {2, 0, -1, 1, 55413.0},  {2, 0, -1, -1, 46271.0}, {2, 0, 0, 1, 32573.0},   {0, 0, 2, 1, 17198.0},
    {2, 0, 1, -1, 9266.0},   {0, 0, 2, -1, 8822.0},   {2, -1, 0, -1, 8216.0},  {2, 0, -2, -1, 4324.0},
    {2, 0, 1, 1, 4200.0},    {2, 1, 0, -1, -3359.0},  {2, -1, -1, 1, 2463.0},  {2, -1, 0, 1, 2211.0},
    {2, -1, -1, -1, 2065.0}};

constexpr MoonTerm kMoonDistance[] = {
    {0, 0, 1, 0, -20905355.0}, {2, 0, -1, 0, -3699111.0}, {2, 0, 0, 0, -2955968.0}, {0, 0, 2, 0, -569925.0},
    {2, 0, -2, 0, 246158.0},   {2, -1, 0, 0, -204586.0},  {2, 0, 1, 0, -170733.0},  {2, -1, -1, 0, -152138.0},
    {0, 1, -1, 0, -129620.0},  {1, 0, 0, 0, 108743.0},    {0, 1, 1, 0, 104755.0},   {0, 0, 1, -2, 79661.0},
    {0, 1, 0, 0, 48888.0}};

/// The Sun's place, equinox of date.
Equatorial sun_of_date(double julian_date) {
  return apparent_place({place_of_sun(julian_date), 0.0, 0.0}, julian_date);
}

}  // namespace

MoonPlace place_of_moon(double julian_date) {
  const double t = (julian_date - kJ2000) / kDaysPerCentury;
  const double mean_longitude = 218.3164477 + t * (481267.88123421 - 0.0015786 * t);
  const double elongation = 297.8501921 + t * (445267.1114034 - 0.0018819 * t);
  const double sun_anomaly = 357.5291092 + t * (35999.0502909 - 0.0001536 * t);
  const double anomaly = 134.9633964 + t * (477198.8675055 + 0.0087414 * t);
  const double from_node = 93.2720950 + t * (483202.0175233 - 0.0036539 * t);
  const double orbit = 1.0 - t * (0.002516 + 0.0000074 * t);  // the Earth's eccentricity over that of J2000
  const double venus = 119.75 + 131.849 * t, jupiter = 53.09 + 479264.290 * t;
  const auto sum_of = [&](const auto& terms, const auto& function) {
    double sum = 0.0;
    for (const MoonTerm& term : terms) {
      const double angle =
          term.elongation * elongation + term.sun * sun_anomaly + term.moon * anomaly + term.node * from_node;
      sum += term.size * std::pow(orbit, std::abs(term.sun)) * function(angle);
    }
    return sum;
  };
  MoonPlace moon;
  const double longitude =
      mean_longitude + 1e-6 * (sum_of(kMoonLongitude, sin_deg) + 3958.0 * sin_deg(venus) +
                               1962.0 * sin_deg(mean_longitude - from_node) + 318.0 * sin_deg(jupiter));
  moon.longitude_deg = longitude - 360.0 * std::floor(longitude / 360.0);
  moon.latitude_deg = 1e-6 * (sum_of(kMoonLatitude, sin_deg) - 2235.0 * sin_deg(mean_longitude));
  constexpr double kMeanDistance_km = 385000.56, kEquator_km = 6378.14;
  moon.parallax_deg =
      std::asin(kEquator_km / (kMeanDistance_km + 1e-3 * sum_of(kMoonDistance, cos_deg))) / kRadiansPerDegree;
  return moon;
}

double magnitude_of_moon(double phase_angle_deg) {
  const double a = std::abs(phase_angle_deg);
  return -12.73 + 0.026 * a + 4e-9 * a * a * a * a;
}

double phase_angle_of_moon_deg(double julian_date) {
  const double separation_from_sun_deg =
      separation_deg(equatorial_place_of_moon(julian_date), sun_of_date(julian_date));
  // The triangle of Sun, Earth and Moon, whose sides are in the Earth's distance from the Sun.
  constexpr double kEquator_au = 6378.14 / 149597870.7;
  const double moon = kEquator_au / sin_deg(place_of_moon(julian_date).parallax_deg);
  return std::atan2(sin_deg(separation_from_sun_deg), moon - cos_deg(separation_from_sun_deg)) /
         kRadiansPerDegree;
}

Equatorial equatorial_place_of_moon(double julian_date) {
  const MoonPlace moon = place_of_moon(julian_date);
  const double t = (julian_date - kJ2000) / kDaysPerCentury;
  const double obliquity_deg = 23.4393 - 0.0130 * t;  // Lieske 1979, its first two terms
  const double x = cos_deg(moon.latitude_deg) * cos_deg(moon.longitude_deg);
  const double y = cos_deg(moon.latitude_deg) * sin_deg(moon.longitude_deg);
  const double z = sin_deg(moon.latitude_deg);
  const double c = cos_deg(obliquity_deg), s = sin_deg(obliquity_deg);
  const double across = c * y - s * z, up = s * y + c * z;
  double right_ascension_deg = std::atan2(across, x) / kRadiansPerDegree;
  if (right_ascension_deg < 0.0) right_ascension_deg += 360.0;
  return {right_ascension_deg, std::atan2(up, std::hypot(x, across)) / kRadiansPerDegree};
}

std::array<double, 3> direction_of_moon(const Observer& observer, double julian_date) {
  const Equatorial place = equatorial_place_of_moon(julian_date);
  const double hour_angle_deg =
      mean_sidereal_time_deg(julian_date) + observer.longitude_deg - place.right_ascension_deg;
  const double declination_deg = place.declination_deg, latitude_deg = observer.latitude_deg;
  const double south_up = cos_deg(declination_deg) * cos_deg(hour_angle_deg);
  std::array<double, 3> enu = {
      -cos_deg(declination_deg) * sin_deg(hour_angle_deg),
      sin_deg(declination_deg) * cos_deg(latitude_deg) - south_up * sin_deg(latitude_deg),
      sin_deg(declination_deg) * sin_deg(latitude_deg) + south_up * cos_deg(latitude_deg)};
  // In units of the Moon's distance the observer stands this far above the Earth's centre.
  enu[2] -= sin_deg(place_of_moon(julian_date).parallax_deg);
  const double length = std::sqrt(enu[0] * enu[0] + enu[1] * enu[1] + enu[2] * enu[2]);
  for (double& component : enu) component /= length;
  return enu;
}

double lit_share_of_moon(double julian_date) {
  const double apart_deg = separation_deg(equatorial_place_of_moon(julian_date), place_of_sun(julian_date));
  return 0.5 * (1.0 - cos_deg(apart_deg));
}

}  // namespace vegard::sim
