#include "fit/measurement/together/pair_of_pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "fit/photo/frames/frame_name.h"
#include "fit/photo/pointing/scene_camera.h"
#include "fit/triangulation/shared_view.h"
#include "sim/base/file/input_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/utc_time.h"
#include "sim/scene/rows/parameter_rules.h"

namespace vegard::fit {
namespace pair_of_pictures {

namespace fs = std::filesystem;

constexpr double kShortestBase_km = 2.0;
constexpr double kLeastShared = 0.005;
constexpr double kSharedHeight_km = 110.0;
constexpr double kClearWeight = 0.9, kClearPattern_km = 20.0;  ///< of a pattern
/// The least error of a direction: of a lens between its stars (docs/pointing.md).
constexpr double kLeastPointing_deg = 0.03;

/// Why a picture cannot be matched with others; empty: it can.
std::string lacking_of(const Measurement& m) {
  if (!m.site) return "the place of " + m.photo + " is not known (--site)";
  if (m.camera_file.empty() || !m.camera) return "where the camera of " + m.photo + " points is not known";
  if (!m.has_azimuth) return "the azimuth of " + m.photo + " is not known";
  return "";
}

std::optional<double> pointing_error_deg(const Measurement& m, const TogetherRequest& request) {
  if (request.pointing_error_deg) return request.pointing_error_deg;
  const std::optional<double> told = direction_error_deg_in(sim::input_bytes(m.camera_file, "a camera"));
  if (!told) return std::nullopt;
  return std::max(*told, kLeastPointing_deg);
}

PlacedCamera camera_of(const Measurement& m, double pointing_error, double clock_error_s, EarthShape earth) {
  PlacedCamera camera;
  camera.name = m.photo;
  camera.camera = *m.camera;
  camera.site.latitude_deg = m.site->latitude_deg;
  camera.site.longitude_deg = m.site->longitude_deg;
  camera.site.altitude_m = m.site->height_m;
  camera.pointing_error_deg = pointing_error;
  camera.clock_error_s = clock_error_s;
  camera.is_refracted = earth == EarthShape::wgs84;
  return camera;
}

/// The year of a picture, for the field, which changes little from one to the next.
double year_of(const Measurement& m) {
  constexpr double kUsualYear = 2020.0, kSecondsPerYear = 31556952.0;
  const std::optional<double> seconds = sim::utc_seconds(m.time_utc);
  if (!seconds) return kUsualYear;
  return std::clamp(1970.0 + *seconds / kSecondsPerYear, sim::kFirstIgrfYear, sim::kLastIgrfYear - 0.1);
}

/// The standard deviation of the light's movement between the pictures.
double moved_km(const PairOfPictures& pair, const TogetherRequest& request) {
  return request.drift_km_s *
         std::hypot(pair.cameras[0].camera().clock_error_s, pair.cameras[1].camera().clock_error_s);
}

void compare_profiles(PairOfPictures& pair, const TogetherRequest& request,
                      const std::vector<const Photo*>& photos, const std::vector<const Measurement*>& alone) {
  ProfileSettings settings;
  settings.year = year_of(*alone[0]);
  settings.threads = request.pictures[pair.first].threads;
  settings.moved_km = moved_km(pair, request);
  std::vector<ProfileMatch> found(2);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::optional<std::size_t> trace = compared_trace(pair, *alone[i], i);
    if (!trace || !alone[i]->border) continue;
    const BorderTrace& border = alone[i]->border->traces[*trace];
    const BorderCurve curve = {curve_of_trace(border, pair.cameras[i], i),
                               curve_of_trace(border, pair.cameras[i], i, level_error(border))};
    if (curve.border.points.size() != curve.higher.points.size()) continue;
    found[i] = profile_match(pair.cameras, photos, curve, settings);
  }
  pair.profiles = joined_profiles(found[0], found[1]);
  if (!pair.profiles.is_given()) return;
  MovedPair two = moved_pair(pair);
  two.first = 0;
  two.second = 1;
  pair.clocks = clock_solution(2, {two}, request.clock_error_s, request.drift_km_s);
}

void look_for_heights(PairOfPictures& pair, const TogetherRequest& request, const Measurement& a,
                      const Measurement& b) {
  if (a.border && b.border)
    pair.borders =
        border_matches(pair.cameras, 0, *a.border, 1, *b.border, {70.0, 300.0}, request.drift_km_s);
  for (std::size_t i = 0; i < 2; ++i) {
    const Measurement& one = i == 0 ? a : b;
    if (const auto trace = compared_trace(pair, one, i); trace && one.border)
      pair.is_peak_cut = pair.is_peak_cut || is_peak_cut(one.border->traces[*trace]);
  }
  std::vector<Photo> photos;
  for (const std::size_t i : {pair.first, pair.second}) {
    const MeasureRequest& picture = request.pictures[i];
    photos.push_back(
        read_photo(picture.photo, decoding_of_word(picture.decoding.empty() ? "auto" : picture.decoding)));
    const std::string mask = folder_of(request, i) + "/sky.png";
    if (!picture.mask.empty())
      apply_mask(photos.back(), picture.mask);
    else if (fs::exists(mask))
      apply_mask(photos.back(), mask);
  }
  for (std::size_t i = 0; i < 2; ++i)
    if (photos[i].linear.width != pair.cameras[i].camera().camera.width ||
        photos[i].linear.height != pair.cameras[i].camera().camera.height)
      return;  // averaged while it was read
  ShellSettings settings;
  settings.moved_km = moved_km(pair, request);
  pair.pattern = shell_correlation(pair.cameras, {&photos[0], &photos[1]}, settings);
  compare_profiles(pair, request, {&photos[0], &photos[1]}, {&a, &b});
}

/// The middle of the exposure, or its beginning if its length is not known; none without a time of the
/// picture's own: a camera's file has the time of the stars by which it was calibrated.
std::optional<double> instant_of(const Measurement& m) {
  const std::optional<double> begin = m.is_time_of_camera ? std::nullopt : sim::utc_seconds(m.time_utc);
  if (!begin) return std::nullopt;
  return *begin + m.middle_after_s.value_or(0.0);
}

}  // namespace pair_of_pictures

PairOfPictures pair_of(const TogetherRequest& request, const std::vector<Measurement>& alone,
                       std::size_t first, std::size_t second) {
  using namespace pair_of_pictures;
  PairOfPictures pair;
  pair.first = first;
  pair.second = second;
  const Measurement &a = alone[first], &b = alone[second];
  const auto at_a = instant_of(a), at_b = instant_of(b);
  if (at_a && at_b) {
    pair.later_s = *at_b - *at_a;
    pair.apart_s = std::abs(pair.later_s);
  }
  // Brighter at its beginning or end, the light of a longer exposure is not that of its middle.
  pair.exposures_s = std::abs(a.middle_after_s.value_or(0.0) - b.middle_after_s.value_or(0.0));
  pair.smeared_km = request.drift_km_s * pair.exposures_s;
  for (const Measurement* m : {&a, &b})
    if (const std::string lacking = lacking_of(*m); pair.refusal.empty() && !lacking.empty())
      pair.refusal = lacking;
  if (!pair.refusal.empty()) return pair;
  std::vector<double> errors;
  for (const Measurement* m : {&a, &b}) {
    const std::optional<double> error = pointing_error_deg(*m, request);
    if (!error) {
      pair.refusal = "how well the camera of " + m->photo + " is known is not said (--pointing-error)";
      return pair;
    }
    errors.push_back(*error);
  }
  // The light moves while the pictures are apart.
  const double apart_s = std::isfinite(pair.apart_s) ? pair.apart_s : 0.0;
  pair.cameras.emplace_back(camera_of(a, errors[0], request.clock_error_s, request.earth), request.earth);
  pair.cameras.emplace_back(
      camera_of(b, errors[1], std::hypot(request.clock_error_s, apart_s, pair.exposures_s), request.earth),
      request.earth);
  const Eigen::Vector3d base = pair.cameras[1].place_km() - pair.cameras[0].place_km();
  const Eigen::Vector3d enu = east_north_up({a.site->latitude_deg, a.site->longitude_deg, 0.0}) * base;
  pair.base_km = base.norm();
  pair.base_azimuth_deg = std::fmod(std::atan2(enu[0], enu[1]) / sim::kRadiansPerDegree + 360.0, 360.0);
  if (pair.apart_s > kLongestApart_s) {
    pair.refusal = fmt::format("the pictures are {:.0f} s apart, and aurora moves meanwhile", pair.apart_s);
  } else if (pair.base_km < kShortestBase_km) {
    pair.refusal = fmt::format("both were taken at the same place, within {:.1f} km", pair.base_km);
  } else {
    pair.shared_share = shared_sky(pair.cameras[0], pair.cameras[1], kSharedHeight_km);
    // A narrow view in a wide one is all shared, and little of the wide one.
    const double by_second = shared_sky(pair.cameras[1], pair.cameras[0], kSharedHeight_km);
    if (std::max(pair.shared_share, by_second) < kLeastShared)
      pair.refusal = "the pictures share no sky at a height of 110 km";
  }
  if (pair.refusal.empty()) look_for_heights(pair, request, a, b);
  return pair;
}

std::string folder_of(const TogetherRequest& request, std::size_t picture) {
  return request.out + "/picture_" + std::to_string(picture + 1);
}

PairOfPictures::PairOfPictures()
    : base_km(sim::kNaN), base_azimuth_deg(sim::kNaN), apart_s(sim::kNaN), shared_share(sim::kNaN) {}

const BorderMatch* best_border(const PairOfPictures& pair) {
  return pair.borders.matches.empty() ? nullptr : &pair.borders.matches.front();
}

const ShellHeight* clear_pattern(const PairOfPictures& pair) {
  if (!pair.pattern || pair.pattern->heights.empty()) return nullptr;
  const ShellHeight& best = pair.pattern->heights.front();
  return best.weight >= pair_of_pictures::kClearWeight && best.error_km < pair_of_pictures::kClearPattern_km
             ? &best
             : nullptr;
}

std::optional<std::size_t> compared_trace(const PairOfPictures& pair, const Measurement& alone,
                                          std::size_t which) {
  if (const BorderMatch* best = best_border(pair)) return which == 0 ? best->first_trace : best->second_trace;
  if (alone.main_border) return alone.main_border->trace;
  return std::nullopt;
}

bool has_clear_profiles(const PairOfPictures& pair) {
  return pair.profiles.is_clear() && std::isfinite(pair.clocks.border_error_km);
}

MovedPair moved_pair(const PairOfPictures& pair) {
  const ProfileMatch& found = pair.profiles;
  MovedPair moved;
  moved.first = pair.first;
  moved.second = pair.second;
  moved.apart_s = pair.later_s;
  moved.border_km = found.border_km;
  moved.across_km = found.across_km;
  moved.border_km_per_km = found.border_km_per_km;
  const double square = pair.smeared_km * pair.smeared_km;
  moved.covariance_km2 = found.covariance_km2;
  moved.covariance_km2(0, 0) += square * found.border_km_per_km * found.border_km_per_km;
  moved.covariance_km2(1, 1) += square;
  moved.along = found.along;
  moved.across = found.across;
  return moved;
}

}  // namespace vegard::fit
