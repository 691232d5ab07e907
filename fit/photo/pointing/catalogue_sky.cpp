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
  for (const sim::BrightStar& star : sim::bright_stars()) {
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

}  // namespace vegard::fit
