#include "apps/commands/calibrate_blind.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "apps/options/exit_code.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "fit/photo/mask/circle.h"
#include "fit/photo/pointing/blind/local_stars.h"
#include "fit/photo/pointing/blind/sky_place.h"
#include "sim/view/sky/planets.h"
#include "sim/view/sky/star_place.h"

namespace vegard::apps {
namespace {

void tell_times(const CalibrateOptions& options, const fit::PictureStars& picture, const fit::Frame& frame,
                const fit::SkyOfPicture& sky) {
  if (!sky.observer) {
    say("when that was overhead depends on the place: --site LAT,LON\n");
    return;
  }
  if (options.date.empty()) {
    say("at what times of a night the site had that above its horizon: --date YYYY-MM-DD\n");
    return;
  }
  const auto noon = sim::julian_date(options.date + "T12:00:00Z");
  if (!noon) throw usage_error("--date", "'" + options.date + "' is no day", "YYYY-MM-DD, of the evening");
  // The noon of the place, not of Greenwich, begins its night.
  const double local_noon = *noon - sky.observer->longitude_deg / 360.0;
  say("that stood above the horizon of the site in a dark sky%s: %s\n",
      options.level ? ", with the camera level," : "",
      fit::words_of(
          fit::times_of_night(picture.recognition.best, frame, *sky.observer, local_noon, options.level))
          .c_str());
}

/// Those where the picture shows sky, and that the site had above its horizon, if the site is known.
void tell_planets(const fit::PictureStars& picture, const fit::Frame& frame, double julian_date,
                  const std::optional<sim::Observer>& observer,
                  const std::function<bool(const fit::SeenPlanet&)>& is_shown) {
  constexpr double kMinUp = 0.0;
  for (const fit::SeenPlanet& planet : fit::planets_in(picture, frame, julian_date)) {
    if (!is_shown(planet)) continue;
    bool up = true;
    for (const sim::Planet one : sim::kPlanets) {
      if (planet.name != sim::name_of(one) || !observer) continue;
      sim::CataloguePlace place;
      place.j2000 = sim::place_of_planet(one, julian_date);
      up = sim::direction_of_star(place, *observer, julian_date)[2] > kMinUp;
    }
    if (!up) continue;
    if (planet.has_point)
      say("%s: the bright point at (%.1f, %.1f), %.2f deg from its computed place\n", planet.name.c_str(),
          planet.x_px, planet.y_px, planet.off_deg);
    else
      say("%s should be at (%.1f, %.1f), where no bright point is\n", planet.name.c_str(), planet.x_px,
          planet.y_px);
  }
}

}  // namespace

BlindStars recognise_blindly(const CalibrateOptions& options, const fit::Photo& photo,
                             const std::vector<char>& usable, const fit::SkyOfPicture& sky) {
  const fit::Frame frame{photo.linear.width, photo.linear.height, true};
  fit::StarFinderSettings finder;
  finder.min_signal = options.min_signal;
  const fit::PictureStars picture = fit::recognise_picture(photo.linear, finder, usable);
  say("%s\n", fit::words_of(picture.recognition).c_str());
  json_answer() = {{"found", picture.recognition.found}, {"words", fit::words_of(picture.recognition)}};
  BlindStars answer;
  if (!picture.recognition.found) {
    answer.exit_code = doubted;
    return answer;
  }
  const std::optional<fit::CircleFound> found_circle = fit::find_circle(photo);
  std::optional<fit::Circle> circle;
  if (found_circle) circle = found_circle->circle;
  const std::string place =
      fit::words_of(fit::sky_place(picture.recognition.best, frame, circle), picture.recognition.best);
  json_answer()["place"] = place;
  say_text(place);
  const auto is_shown = [&](const fit::SeenPlanet& planet) {
    if (circle && std::hypot(planet.x_px - circle->x_px, planet.y_px - circle->y_px) > circle->radius_px)
      return false;
    const auto column = std::clamp(static_cast<int>(planet.x_px), 0, frame.width_px - 1);
    const auto row = std::clamp(static_cast<int>(planet.y_px), 0, frame.height_px - 1);
    return usable.empty() || usable[static_cast<std::size_t>(row) * frame.width_px + column] != 0;
  };
  answer.table = fit::stars_csv(picture.recognition);
  if (!sky.julian_date || !sky.observer) {
    tell_times(options, picture, frame, sky);
    if (sky.julian_date) tell_planets(picture, frame, *sky.julian_date, sky.observer, is_shown);
    if (options.output.empty()) return answer;
    say("no %s: azimuth and elevation need --time and --site. --stars-out STARS.csv keeps the stars, which "
        "'vegard calibrate STARS.csv' takes with them later\n",
        options.output.c_str());
    answer.exit_code = doubted;
    return answer;
  }
  tell_planets(picture, frame, *sky.julian_date, sky.observer, is_shown);
  const fit::LocalStars local = fit::local_stars(picture, frame, *sky.observer, *sky.julian_date,
                                                 options.faintest, options.min_elevation_deg);
  if (local.elsewhere) {
    say("the time or the site is not this picture's: %d of its %d recognised stars were below the horizon "
        "there then. Nothing was written but what the stars say alone\n",
        local.below_horizon, local.recognised);
    answer.exit_code = doubted;
    return answer;
  }
  if (options.output.empty()) return answer;
  answer.local = true;
  answer.camera = local.camera;
  answer.stars = local.stars;
  say("with time and site: %zu of the %d stars to magnitude %.1f that should be seen have a point within "
      "%.1f px (%.1f would by chance)\n",
      answer.stars.size(), local.again.in_frame, options.faintest, local.again.last_radius_px,
      local.again.by_chance);
  return answer;
}

}  // namespace vegard::apps
