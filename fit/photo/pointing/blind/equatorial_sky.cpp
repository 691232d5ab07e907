#include "fit/photo/pointing/blind/equatorial_sky.h"

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/view/sky/bright_stars.h"

namespace vegard::fit {

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
