#include "fit/photo/pointing/catalogue_sky.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "fit/photo/pointing/chance_agreement.h"
#include "sim/base/number/constants.h"
#include "sim/view/sky/bright_stars.h"

namespace vegard::fit {
namespace {

Eigen::Vector3d direction_of(const StarSighting& star) { return {star.enu[0], star.enu[1], star.enu[2]}; }

std::vector<StarSighting> equatorial(const std::vector<sim::BrightStar>& stars) {
  std::vector<StarSighting> all;
  for (const sim::BrightStar& star : stars) {
    StarSighting one;
    const Eigen::Vector3d v = equatorial_vector(star.place.j2000);
    one.enu = {v[0], v[1], v[2]};
    one.name = star.label();
    one.magnitude = star.magnitude;
    all.push_back(one);
  }
  return all;
}

}  // namespace

std::vector<StarSighting> catalogue_sky(const sim::Observer& observer, double julian_date, double faintest,
                                        double min_elevation_deg, double apart_deg) {
  std::vector<StarSighting> sky;
  const double min_up = std::sin(min_elevation_deg * sim::kRadiansPerDegree);
  const double near = std::cos(apart_deg * sim::kRadiansPerDegree);
  const bool is_deep = faintest > sim::kFaintestCatalogued;
  for (const sim::BrightStar& star : is_deep ? sim::deep_stars() : sim::catalogue_stars()) {
    if (star.magnitude > faintest) break;
    StarSighting one;
    one.enu = sim::direction_of_star(star.place, observer, julian_date);
    if (one.enu[2] < min_up) continue;
    bool alone = true;
    for (std::size_t i = 0; apart_deg > 0.0 && alone && i < sky.size(); ++i) {
      const StarSighting& other = sky[i];
      alone = one.enu[0] * other.enu[0] + one.enu[1] * other.enu[1] + one.enu[2] * other.enu[2] < near;
    }
    if (!alone) continue;
    one.name = star.label();
    one.magnitude = star.magnitude;
    sky.push_back(one);
  }
  return sky;
}

std::vector<StarSighting> field_sky(const SkyCamera& camera, const Frame& frame,
                                    const sim::Observer& observer, double julian_date,
                                    double min_elevation_deg, double apart_deg, int enough) {
  constexpr double kWidest_deg = 14.0;  // from the middle to the farthest corner
  constexpr double kApart = 0.005, kBeyond = 1.3;
  std::vector<StarSighting> sky =
      catalogue_sky(observer, julian_date, sim::kFaintestCatalogued, min_elevation_deg, apart_deg);
  const std::optional<FieldCone> cone = field_cone(camera, frame);
  if (!cone || cone->radius_rad > kWidest_deg * sim::kRadiansPerDegree ||
      static_cast<int>(expected_stars(camera, frame, sky).size()) >= enough)
    return sky;
  const double min_up = std::sin(min_elevation_deg * sim::kRadiansPerDegree);
  const double least = std::cos(kBeyond * cone->radius_rad);
  const double longer_px = std::max(frame.width_px, frame.height_px);
  const double apart_rad = apart_deg > 0.0 ? kApart * longer_px / camera.numbers[focal_px_number] : 0.0;
  sky.clear();
  for (const sim::BrightStar& star : sim::deep_stars()) {
    StarSighting one;
    one.enu = sim::direction_of_star(star.place, observer, julian_date);
    const Eigen::Vector3d v = direction_of(one);
    if (one.enu[2] < min_up || v.dot(cone->middle) < least) continue;
    const bool alone = std::none_of(sky.begin(), sky.end(), [&](const StarSighting& other) {
      return (v - direction_of(other)).norm() < apart_rad;
    });
    if (!alone) continue;
    one.name = star.label();
    one.magnitude = star.magnitude;
    sky.push_back(one);
  }
  return sky;
}

std::optional<FieldCone> field_cone(const SkyCamera& camera, const Frame& frame) {
  const sim::Lens<double> lens = true_lens(camera);
  const auto looks = [&](double x, double y, Eigen::Vector3d& direction) {
    double v[3];
    if (!sim::unproject(lens, x, y, v)) return false;
    direction = camera.camera_from_enu.transpose() * Eigen::Vector3d(v[0], v[1], v[2]);
    return true;
  };
  FieldCone cone;
  if (!looks(0.5 * frame.width_px, 0.5 * frame.height_px, cone.middle)) return std::nullopt;
  for (const double x : {0.0, 1.0})
    for (const double y : {0.0, 1.0}) {
      Eigen::Vector3d corner;
      if (!looks(x * frame.width_px, y * frame.height_px, corner)) return std::nullopt;
      cone.radius_rad =
          std::max(cone.radius_rad, std::atan2(cone.middle.cross(corner).norm(), cone.middle.dot(corner)));
    }
  return cone;
}

const std::vector<StarSighting>& equatorial_sky() {
  static const std::vector<StarSighting> sky = equatorial(sim::bright_stars());
  return sky;
}

const std::vector<StarSighting>& deep_equatorial_sky() {
  static const std::vector<StarSighting> sky = equatorial(sim::deep_stars());
  return sky;
}

const StarSighting& equatorial_star(int index) {
  const auto i = static_cast<std::size_t>(index);
  return i < equatorial_sky().size() ? equatorial_sky()[i] : deep_equatorial_sky()[i];
}

const sim::CataloguePlace& catalogue_place(int index) {
  const auto i = static_cast<std::size_t>(index);
  return i < sim::catalogue_stars().size() ? sim::catalogue_stars()[i].place : sim::deep_stars()[i].place;
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
