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

}  // namespace

MoonPlace place_of_moon(double julian_date) {
  const double t = (julian_date - kJ2000) / kDaysPerCentury;
  MoonPlace moon;
  const double longitude = 218.32 + 481267.881 * t + 6.29 * sin_deg(135.0 + 477198.87 * t) -
                           1.27 * sin_deg(259.3 - 413335.36 * t) + 0.66 * sin_deg(235.7 + 890534.22 * t) +
                           0.21 * sin_deg(269.9 + 954397.74 * t) - 0.19 * sin_deg(357.5 + 35999.05 * t) -
                           0.11 * sin_deg(186.5 + 966404.03 * t);
  moon.longitude_deg = longitude - 360.0 * std::floor(longitude / 360.0);
  moon.latitude_deg = 5.13 * sin_deg(93.3 + 483202.02 * t) + 0.28 * sin_deg(228.2 + 960400.89 * t) -
                      0.28 * sin_deg(318.3 + 6003.15 * t) - 0.17 * sin_deg(217.6 - 407332.21 * t);
  moon.parallax_deg = 0.9508 + 0.0518 * cos_deg(135.0 + 477198.87 * t) +
                      0.0095 * cos_deg(259.3 - 413335.36 * t) + 0.0078 * cos_deg(235.7 + 890534.22 * t) +
                      0.0028 * cos_deg(269.9 + 954397.74 * t);
  return moon;
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
