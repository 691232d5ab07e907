#include "fit/photo/pointing/blind/sky_place.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <fmt/format.h>

#include "fit/photo/pointing/catalogue_sky.h"
#include "fit/photo/pointing/sky_camera.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"
#include "sim/view/sky/bright_stars.h"
#include "sim/view/sky/planets.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {
namespace {

constexpr double kDegreesPerRadian = 1.0 / sim::kRadiansPerDegree;
constexpr double kDarkSun_deg = -6.0, kLevelRoll_deg = 2.0;
constexpr double kInAir_px = 4.0;  // the scale of Cauchy's loss
constexpr double kMinute_days = 1.0 / 1440.0;

bool looks_at(const sim::Lens<double>& lens, double x, double y, Eigen::Vector3d& direction) {
  double v[3];
  if (!sim::unproject(lens, x, y, v)) return false;
  direction = {v[0], v[1], v[2]};
  return true;
}

bool is_outside(const std::optional<Circle>& circle, double x, double y) {
  return circle && std::hypot(x - circle->x_px, y - circle->y_px) > circle->radius_px;
}

/// The angle from the middle to where the picture, the fisheye's circle or the lens's image ends.
double angle_to(const sim::Lens<double>& lens, const std::optional<Circle>& circle, double x0, double y0,
                double x1, double y1) {
  Eigen::Vector3d middle, there;
  if (!looks_at(lens, x0, y0, middle)) return 0.0;
  double angle = 0.0;
  for (int i = 1; i <= 64; ++i) {
    const double part = i / 64.0;
    const double x = x0 + part * (x1 - x0), y = y0 + part * (y1 - y0);
    if (is_outside(circle, x, y) || !looks_at(lens, x, y, there)) break;
    angle = std::atan2(middle.cross(there).norm(), middle.dot(there)) * kDegreesPerRadian;
  }
  return angle;
}

std::array<double, 3> seen_from(const Eigen::Vector3d& j2000, const sim::Observer& observer,
                                double julian_date) {
  sim::CataloguePlace place;
  place.j2000 = equatorial_place(j2000);
  return sim::direction_of_star(place, observer, julian_date);
}

/// The rotation from the axes of equatorial_sky() to the observer's without air: three directions suffice.
Eigen::Matrix3d enu_from_equatorial(sim::Observer observer, double julian_date) {
  observer.refracting_air = false;
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 3; ++i) {
    const std::array<double, 3> enu = seen_from(Eigen::Vector3d::Unit(i), observer, julian_date);
    rotation.col(i) = Eigen::Vector3d(enu[0], enu[1], enu[2]);
  }
  return Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
}

}  // namespace

SkyPlace sky_place(const GrownCamera& camera, const Frame& frame, const std::optional<Circle>& circle) {
  const sim::Lens<double> lens = true_lens(camera.camera);
  const double x = 0.5 * frame.width_px, y = 0.5 * frame.height_px;
  SkyPlace place;
  Eigen::Vector3d middle = Eigen::Vector3d::UnitZ(), above = middle;
  looks_at(lens, x, y, middle);
  looks_at(lens, x, y - 1.0, above);
  const Eigen::Matrix3d back = camera.camera.camera_from_enu.transpose();
  middle = back * middle;
  const Eigen::Vector3d up = back * above - middle;
  place.centre = equatorial_place(middle);
  const Eigen::Vector3d east = Eigen::Vector3d::UnitZ().cross(middle).normalized();
  place.up_deg = std::atan2(up.dot(east), up.dot(middle.cross(east))) * kDegreesPerRadian;
  place.width_deg =
      angle_to(lens, circle, x, y, 0.5, y) + angle_to(lens, circle, x, y, frame.width_px - 0.5, y);
  place.height_deg =
      angle_to(lens, circle, x, y, x, 0.5) + angle_to(lens, circle, x, y, x, frame.height_px - 0.5);
  place.px_per_deg = camera.camera.numbers[focal_px_number] / kDegreesPerRadian;
  return place;
}

std::string middle_words(const SkyPlace& place) {
  return fmt::format("the picture's middle: right ascension {:.3f} deg, declination {:+.3f} deg (J2000)",
                     place.centre.right_ascension_deg, place.centre.declination_deg);
}

std::string width_words(const SkyPlace& place, const GrownCamera& camera) {
  return fmt::format("field of view: {:.2f} x {:.2f} deg; {:.2f} px to a degree on the axis; lens: {}",
                     place.width_deg, place.height_deg, place.px_per_deg, words_of(camera.form));
}

std::string words_of(const SkyPlace& place, const GrownCamera& camera) {
  return middle_words(place) +
         fmt::format("\nup in the picture is {:.2f} deg from north to the east{}\n", place.up_deg,
                     camera.camera.mirrored ? "; the picture is mirrored" : "") +
         width_words(place, camera) + "\n";
}

std::vector<Interval> times_of_night(const GrownCamera& camera, const Frame& frame,
                                     const sim::Observer& observer, double noon_jd, bool level) {
  const sim::Equatorial centre = sky_place(camera, frame).centre;
  sim::CataloguePlace middle, sun;
  middle.j2000 = centre;
  const double min_up = 0.0, dark = std::sin(kDarkSun_deg * sim::kRadiansPerDegree);
  std::vector<Interval> intervals;
  bool open = false;
  for (int minute = 0; minute <= 1440; ++minute) {
    const double jd = noon_jd + minute * kMinute_days;
    sun.j2000 = sim::place_of_sun(jd);
    bool good = minute < 1440 && sim::direction_of_star(middle, observer, jd)[2] > min_up &&
                sim::direction_of_star(sun, observer, jd)[2] < dark;
    if (good && level) {
      SkyCamera there = camera.camera;
      there.camera_from_enu = camera.camera.camera_from_enu * enu_from_equatorial(observer, jd).transpose();
      good = std::abs(pointing_of(there).roll_deg) < kLevelRoll_deg;
    }
    if (good && !open) intervals.push_back({jd, jd});
    if (good) intervals.back().to_jd = jd;
    open = good;
  }
  return intervals;
}

std::string words_of(const std::vector<Interval>& intervals) {
  if (intervals.empty()) return "at no time of that night: another day or another site";
  std::string words;
  for (const Interval& one : intervals)
    words += (words.empty() ? "" : ", ") + sim::text_of_julian_date(one.from_jd) + " to " +
             sim::text_of_julian_date(one.to_jd);
  return words;
}

Eigen::Vector3d zenith_of(const sim::Observer& observer, double julian_date) {
  return enu_from_equatorial(observer, julian_date).row(2).transpose();
}

LocalSky local_sky(const StarRecognition& recognition, const sim::Observer& observer, double julian_date) {
  LocalSky sky;
  const double lowest_up = std::sin((sim::horizon_elevation_deg(observer) - 1.0) * sim::kRadiansPerDegree);
  sky.camera = recognition.best.camera;
  sky.camera.camera_from_enu =
      recognition.best.camera.camera_from_enu * enu_from_equatorial(observer, julian_date).transpose();
  for (const StarMatch& one : recognition.best.agreement.matches) {
    StarSighting star = equatorial_star(one.star);
    star.enu = sim::direction_of_star(catalogue_place(one.star), observer, julian_date);
    star.x_px = recognition.points[one.point].x_px;
    star.y_px = recognition.points[one.point].y_px;
    sky.below_horizon += star.enu[2] < lowest_up;
    sky.stars.push_back(star);
  }
  std::stable_sort(sky.stars.begin(), sky.stars.end(),
                   [](const StarSighting& a, const StarSighting& b) { return a.magnitude < b.magnitude; });
  return sky;
}

std::vector<SeenPlanet> planets_in(const PictureStars& stars, const Frame& frame, double julian_date,
                                   double reach_deg) {
  const SkyCamera& camera = stars.recognition.best.camera;
  const sim::Lens<double> lens = true_lens(camera);
  const double reach_px = reach_deg * camera.numbers[focal_px_number] * sim::kRadiansPerDegree;
  // A planet that is in no trail of noise is among the brighter half of what was recognised.
  std::vector<double> fluxes;
  for (const StarMatch& one : stars.recognition.best.agreement.matches)
    fluxes.push_back(stars.recognition.points[one.point].flux);
  const double min_flux = sim::median(fluxes);
  std::vector<SeenPlanet> planets;
  for (const sim::Planet planet : sim::kPlanets) {
    const Eigen::Vector3d v =
        camera.camera_from_enu * equatorial_vector(sim::place_of_planet(planet, julian_date));
    const double in_camera[3] = {v[0], v[1], v[2]};
    SeenPlanet one;
    one.name = sim::name_of(planet);
    if (!sim::project(lens, in_camera, one.x_px, one.y_px) || one.x_px < 0.0 || one.y_px < 0.0 ||
        one.x_px > frame.width_px || one.y_px > frame.height_px)
      continue;
    double nearest = std::max(reach_px, 3.0);
    const double x = one.x_px, y = one.y_px;
    for (const FoundStar& point : stars.found) {
      const double distance = std::hypot(point.x_px - x, point.y_px - y);
      if (point.flux < min_flux || distance >= nearest) continue;
      nearest = distance;
      one.has_point = true;
      one.x_px = point.x_px;
      one.y_px = point.y_px;
    }
    if (one.has_point) one.off_deg = nearest / (reach_px / reach_deg);
    planets.push_back(one);
  }
  return planets;
}

std::string stars_csv(const StarRecognition& recognition) {
  std::string text = "name,ra_deg,dec_deg,magnitude,x_px,y_px\n";
  for (const StarSighting& star : recognition.stars()) {
    const sim::Equatorial place = equatorial_place({star.enu[0], star.enu[1], star.enu[2]});
    char line[200];
    std::snprintf(line, sizeof line, "%s,%.4f,%.4f,%.2f,%.3f,%.3f\n", star.name.c_str(),
                  place.right_ascension_deg, place.declination_deg, star.magnitude, star.x_px, star.y_px);
    text += line;
  }
  return text;
}

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
  const std::vector<StarSighting> catalogue =
      field_sky(local.camera, frame, observer, julian_date,
                sim::horizon_elevation_deg(observer) + std::max(0.0, min_elevation_deg));
  const bool is_narrow = !catalogue.empty() && catalogue.back().magnitude > sim::kFaintestCatalogued;
  settings.faintest = is_narrow ? faintest_for_field(local.camera, frame, catalogue, faintest) : faintest;
  settings.first_magnitude = answer.faintest = settings.faintest;
  settings.twist_deg = settings.shift_px = 0.0;
  settings.first_radius_px = 4.0 * unit;
  settings.last_radius_px = 2.5 * unit;
  settings.free = free_numbers(picture.recognition.best.form, !is_narrow);
  // Near the horizon the air moves a narrow field by many pixels.
  if (is_narrow) {
    const CameraFit in_air =
        fit_camera(local.camera, free_numbers({local.camera.model, 0, false, false}, false), local.stars, {},
                   kInAir_px * unit);
    if (in_air.good) local.camera = in_air.camera;
  }
  std::vector<StarSighting> bright = catalogue;
  bright.erase(std::find_if(bright.begin(), bright.end(),
                            [&](const StarSighting& one) { return one.magnitude > settings.faintest; }),
               bright.end());
  answer.again = identify(local.camera, frame, bright, picture.found, settings);
  const bool trusted = is_trustworthy(answer.again);
  answer.camera = trusted ? answer.again.camera : local.camera;
  answer.stars = trusted ? answer.again.stars : std::move(local.stars);
  return answer;
}

}  // namespace vegard::fit
