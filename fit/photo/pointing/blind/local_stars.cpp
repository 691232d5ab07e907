#include "fit/photo/pointing/blind/local_stars.h"

#include <algorithm>

#include "fit/photo/pointing/blind/sky_place.h"
#include "fit/photo/pointing/catalogue_sky.h"

namespace vegard::fit {

LocalStars local_stars(const PictureStars& picture, const Frame& frame, const sim::Observer& observer,
                       double julian_date, double faintest, double min_elevation_deg) {
  LocalSky local = local_sky(picture.recognition, observer, julian_date);
  LocalStars answer;
  answer.recognised = static_cast<int>(local.stars.size());
  answer.below_horizon = local.below_horizon;
  answer.elsewhere = 10 * local.below_horizon > answer.recognised;
  if (answer.elsewhere) return answer;
  // Once more among all points, now that air and the site's own horizon are known.
  IdentificationSettings settings;
  const double unit = picture.smaller;
  settings.faintest = faintest;
  settings.first_magnitude = faintest;
  settings.twist_deg = settings.shift_px = 0.0;
  settings.first_radius_px = 4.0 * unit;
  settings.last_radius_px = 2.5 * unit;
  settings.free = free_numbers(picture.recognition.best.form, true);
  const std::vector<StarSighting> catalogue =
      catalogue_sky(observer, julian_date, faintest, std::max(0.0, min_elevation_deg));
  answer.again = identify(local.camera, frame, catalogue, picture.found, settings);
  const bool trusted = is_trustworthy(answer.again);
  answer.camera = trusted ? answer.again.camera : local.camera;
  answer.stars = trusted ? answer.again.stars : std::move(local.stars);
  return answer;
}

}  // namespace vegard::fit
