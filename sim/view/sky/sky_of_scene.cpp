#include "sim/view/sky/sky_of_scene.h"

#include <cmath>
#include <optional>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/planets.h"
#include "sim/view/sky/star_place.h"

namespace vegard::sim {
namespace {

constexpr double kAirEnds_m = 80e3;
constexpr double kSecondsOfDay = 86400.0;
constexpr double kLowestSun_deg = -15.0, kHighestSun_deg = -5.0;

}  // namespace

Observer observer_of(const Scene& scene) {
  return {scene.site.latitude_deg, scene.site.longitude_deg, scene.site.altitude_m,
          scene.site.altitude_m < kAirEnds_m};
}

double julian_date_at(const Scene& scene, double instant_s) {
  const std::optional<double> start = julian_date(scene.site.time_utc);
  if (!start)
    throw Error(ErrorKind::scene, "the real sky of '" + scene.site.time_utc + "' is not known")
        .file(scene.file)
        .key("site.time_utc")
        .expected("date and time of day of the years 1900 to 2200, such as \"2019-09-01T05:00:00Z\"");
  return *start + instant_s / kSecondsOfDay;
}

Twilight twilight_at(const Scene& scene) {
  Twilight twilight = scene.twilight;
  if (!twilight.shown || twilight.sun == TwilightSun::given) return twilight;
  const double date = julian_date_at(scene, scene.time.start_s);
  const std::array<double, 3> sun =
      direction_of_star({place_of_sun(date), 0.0, 0.0}, observer_of(scene), date);
  const Direction at = direction_of_enu(sun.data());
  twilight.sun_azimuth_deg = at.azimuth_deg;
  twilight.sun_elevation_deg = at.elevation_deg;
  twilight.shown = at.elevation_deg >= kLowestSun_deg;
  if (at.elevation_deg > kHighestSun_deg)
    throw Error(ErrorKind::scene, "the sun is at an elevation of " +
                                      std::to_string(std::lround(at.elevation_deg)) + " degrees then")
        .file(scene.file)
        .key("twilight.sun")
        .expected("at most -5, up to where the twilight sky was measured")
        .hint("set site.time_utc to a darker time");
  return twilight;
}

}  // namespace vegard::sim
