#include "fit/photo/pointing/catalogue_sky.h"

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/view/sky/bright_stars.h"

namespace vegard::fit {

std::vector<StarSighting> catalogue_sky(const sim::Observer& observer, double julian_date, double faintest,
                                        double min_elevation_deg, double apart_deg) {
  std::vector<StarSighting> sky;
  const double min_up = std::sin(min_elevation_deg * sim::kRadiansPerDegree);
  const double near = std::cos(apart_deg * sim::kRadiansPerDegree);
  for (const sim::BrightStar& star : sim::catalogue_stars()) {
    if (star.magnitude > faintest) break;
    StarSighting one;
    one.enu = sim::direction_of_star(star.place, observer, julian_date);
    if (one.enu[2] < min_up) continue;
    bool alone = true;
    for (const StarSighting& other : sky)
      alone =
          alone && one.enu[0] * other.enu[0] + one.enu[1] * other.enu[1] + one.enu[2] * other.enu[2] < near;
    if (!alone) continue;
    one.name = star.label();
    one.magnitude = star.magnitude;
    sky.push_back(one);
  }
  return sky;
}

const std::vector<StarSighting>& equatorial_sky() {
  static const std::vector<StarSighting> sky = [] {
    std::vector<StarSighting> all;
    for (const sim::BrightStar& star : sim::bright_stars()) {
      StarSighting one;
      const Eigen::Vector3d v = equatorial_vector(star.place.j2000);
      one.enu = {v[0], v[1], v[2]};
      one.name = star.label();
      one.magnitude = star.magnitude;
      all.push_back(one);
    }
    return all;
  }();
  return sky;
}

Eigen::Vector3d equatorial_vector(const sim::Equatorial& place) {
  const double a = place.right_ascension_deg * sim::kRadiansPerDegree;
  const double d = place.declination_deg * sim::kRadiansPerDegree;
  return {std::cos(d) * std::cos(a), std::cos(d) * std::sin(a), std::sin(d)};
}

sim::Equatorial equatorial_place(const Eigen::Vector3d& v) {
  double a = std::atan2(v[1], v[0]) / sim::kRadiansPerDegree;
  if (a < 0.0) a += 360.0;
  return {a, std::atan2(v[2], std::hypot(v[0], v[1])) / sim::kRadiansPerDegree};
}

}  // namespace vegard::fit
