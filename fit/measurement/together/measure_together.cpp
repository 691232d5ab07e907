#include "fit/measurement/together/measure_together.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "fit/measurement/main_border.h"
#include "fit/measurement/measure_run.h"
#include "fit/photo/frames/frame_name.h"
#include "fit/photo/pointing/scene_camera.h"
#include "fit/triangulation/shared_view.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/sha256.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace together {

namespace fs = std::filesystem;

constexpr double kShortestBase_km = 2.0;
constexpr double kLeastShared = 0.005;
constexpr double kSharedHeight_km = 110.0;
constexpr double kClearWeight = 0.9, kClearPattern_km = 20.0;  ///< of a pattern
constexpr double kGoodError_km = 5.0;
/// The least error of a direction: of a lens between its stars (docs/pointing.md).
constexpr double kLeastPointing_deg = 0.03;

std::string folder_of(const TogetherRequest& request, std::size_t picture) {
  return request.out + "/picture_" + std::to_string(picture + 1);
}

/// Refuses what measure() would refuse, and masks that are no files, before the first picture takes its time.
void check_inputs(const TogetherRequest& request, const MeasureFollower& follower) {
  for (const MeasureRequest& picture : request.pictures) {
    const std::string file = file_of_frame(picture.photo);
    for (const std::string& name : {file, picture.camera, picture.mask})
      if (const std::string problem = name.empty() ? "" : sim::why_no_input(name); !problem.empty())
        throw sim::unreadable(name, problem);
    MeasureRun(picture, follower).read_given();
  }
}

void refuse_same_pictures(const TogetherRequest& request) {
  std::vector<std::string> sums;
  for (const MeasureRequest& picture : request.pictures) {
    std::string sum = sim::sha256_of_file(file_of_frame(picture.photo));
    if (picture.photo != file_of_frame(picture.photo)) sum += picture.photo;
    const auto same = std::find(sums.begin(), sums.end(), sum);
    if (same != sums.end())
      throw usage_error("PHOTO",
                        "'" + picture.photo + "' is the same picture as '" +
                            request.pictures[static_cast<std::size_t>(same - sums.begin())].photo + "'",
                        "pictures from different places",
                        "one picture alone has no height by geometry: give it alone to vegard measure");
    sums.push_back(sum);
  }
}

void claim_folder(const TogetherRequest& request) {
  std::error_code failed;
  const bool is_there = fs::exists(request.out, failed);
  if (is_there && !fs::is_directory(request.out, failed))
    throw sim::Error(sim::ErrorKind::existing_output, "is no folder").file(request.out);
  if (is_there && !fs::is_empty(request.out, failed)) {
    if (!request.overwrite) throw sim::already_exists(request.out);
    if (!fs::exists(request.out + "/together.json"))
      throw sim::Error(sim::ErrorKind::existing_output,
                       "holds something that is no measurement of several pictures")
          .file(request.out);
  }
  // What an earlier measurement of more pictures has left would seem to be of this one.
  fs::remove(request.out + "/report.html", failed);
  for (std::size_t i = request.pictures.size();; ++i) {
    const std::string surplus = folder_of(request, i);
    if (!fs::exists(surplus + "/measure.json", failed)) break;
    fs::remove_all(surplus, failed);
  }
  fs::create_directories(request.out, failed);
  if (failed)
    throw sim::Error(sim::ErrorKind::unwritable_output, "cannot be made: " + failed.message())
        .file(request.out);
  sim::write_whole(request.out + "/together.json",
                   "{\"kind\": \"vegard measure, several\", \"interrupted\": true}\n", true);
}

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

void look_for_heights(PairOfPictures& pair, const TogetherRequest& request, const Measurement& a,
                      const Measurement& b) {
  if (a.border && b.border)
    pair.borders =
        border_matches(pair.cameras, 0, *a.border, 1, *b.border, {70.0, 300.0}, request.drift_km_s);
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
  settings.moved_km = request.drift_km_s * std::hypot(pair.cameras[0].camera().clock_error_s,
                                                      pair.cameras[1].camera().clock_error_s);
  pair.pattern = shell_correlation(pair.cameras, {&photos[0], &photos[1]}, settings);
}

/// The middle of the exposure, or its beginning if its length is not known; none without a time of the
/// picture's own: a camera's file has the time of the stars by which it was calibrated.
std::optional<double> instant_of(const Measurement& m) {
  const std::optional<double> begin = m.is_time_of_camera ? std::nullopt : sim::utc_seconds(m.time_utc);
  if (!begin) return std::nullopt;
  return *begin + m.middle_after_s.value_or(0.0);
}

PairOfPictures pair_of(const TogetherRequest& request, const std::vector<Measurement>& alone,
                       std::size_t first, std::size_t second) {
  PairOfPictures pair;
  pair.first = first;
  pair.second = second;
  const Measurement &a = alone[first], &b = alone[second];
  const auto at_a = instant_of(a), at_b = instant_of(b);
  if (at_a && at_b) pair.apart_s = std::abs(*at_a - *at_b);
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
      camera_of(b, errors[1], std::hypot(request.clock_error_s, apart_s), request.earth), request.earth);
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

std::string border_sentence(const BorderMatch& match, const PairOfPictures& pair) {
  const MeanHeight& mean = match.branch.mean;
  return fmt::format(
      "The lower border is {} km high by geometry alone ({} points of the border in both pictures; {:.0f} km "
      "between the cameras).",
      sim::number_with_error(mean.km, mean.error_km), mean.points, pair.base_km);
}

/// Whether nothing speaks against a match, and what does.
std::vector<std::string> doubts_of(const BorderMatch& match, const PairOfPictures& pair) {
  std::vector<std::string> doubts = doubts_about(match.branch, match.weight);
  if (!pair.borders.is_claimed) doubts.push_back("the traces are not claimed to be aurora");
  if (!(match.branch.mean.error_km <= kGoodError_km))
    doubts.push_back(fmt::format("the error is above {:.0f} km", kGoodError_km));
  if (!std::isfinite(pair.apart_s)) doubts.push_back("a time is not known: both are taken for the same");
  if (const ShellHeight* pattern = clear_pattern(pair))
    if (pattern->km + 2.0 * pattern->error_km < match.branch.mean.km - 2.0 * match.branch.mean.error_km)
      doubts.push_back("the light's pattern is lower than its border");
  return doubts;
}

}  // namespace together

bool contradict(const std::vector<MeanHeight>& heights) {
  constexpr double kFarthest = 3.0;  // in standard deviations of the difference
  for (const MeanHeight& a : heights)
    for (const MeanHeight& b : heights)
      if (std::abs(a.km - b.km) > kFarthest * std::hypot(a.error_km, b.error_km)) return true;
  return false;
}

namespace together {

void conclude(TogetherMeasurement& m) {
  std::vector<MeanHeight> good;
  bool has_height = false;
  for (const PairOfPictures& pair : m.pairs) {
    const std::string names = m.alone[pair.first].photo + " and " + m.alone[pair.second].photo;
    if (!pair.refusal.empty()) {
      m.answer.push_back(names + ": no height, " + pair.refusal + ".");
      continue;
    }
    const BorderMatch* border = best_border(pair);
    const ShellHeight* pattern = clear_pattern(pair);
    if (border) {
      has_height = true;
      std::string sentence = border_sentence(*border, pair);
      const std::vector<std::string> doubts = doubts_of(*border, pair);
      if (m.pairs.size() > 1) sentence = names + ": " + sentence;
      m.answer.push_back(sentence);
      for (const std::string& doubt : doubts) m.answer.push_back("With care: " + doubt + ".");
      if (doubts.empty()) good.push_back(border->branch.mean);
    } else {
      m.answer.push_back(names + ": the height of the border is not known, " +
                         (pair.borders.along_epipolar > 0
                              ? std::string("it runs along the line between the cameras.")
                              : std::string("no border of one picture is in the other.")));
    }
    if (pattern) {
      has_height = true;
      m.answer.push_back(fmt::format("The densest light is {} km high (correlation {:.2f}).",
                                     sim::number_with_error(pattern->km, pattern->error_km),
                                     pattern->correlation));
    }
  }
  const bool is_contradicted = contradict(good);
  if (is_contradicted)
    m.answer.push_back("With care: the heights of the pairs contradict each other beyond their errors.");
  const bool is_good = !good.empty() && !is_contradicted;
  m.trust = is_good ? Trust::good : has_height ? Trust::doubtful : Trust::unconstrained;
  m.word = is_good ? "Measured" : has_height ? "With care" : "No height";
}

}  // namespace together

PairOfPictures::PairOfPictures()
    : base_km(sim::kNaN), base_azimuth_deg(sim::kNaN), apart_s(sim::kNaN), shared_share(sim::kNaN) {}

const BorderMatch* best_border(const PairOfPictures& pair) {
  return pair.borders.matches.empty() ? nullptr : &pair.borders.matches.front();
}

const ShellHeight* clear_pattern(const PairOfPictures& pair) {
  if (!pair.pattern || pair.pattern->heights.empty()) return nullptr;
  const ShellHeight& best = pair.pattern->heights.front();
  return best.weight >= together::kClearWeight && best.error_km < together::kClearPattern_km ? &best
                                                                                             : nullptr;
}

TogetherMeasurement measure_together(const TogetherRequest& request, const MeasureFollower& follower) {
  using namespace together;
  check_inputs(request, follower);
  refuse_same_pictures(request);
  claim_folder(request);
  TogetherMeasurement m;
  m.command = request.command;
  m.out = request.out;
  for (std::size_t i = 0; i < request.pictures.size(); ++i) {
    MeasureRequest picture = request.pictures[i];
    picture.out = folder_of(request, i);
    picture.no_map = picture.overwrite = true;
    picture.command = request.command;
    follower.tell("");
    follower.tell("Picture " + std::to_string(i + 1) + ": " + picture.photo);
    m.alone.push_back(measure(picture, follower));
  }
  for (std::size_t a = 0; a < m.alone.size(); ++a)
    for (std::size_t b = a + 1; b < m.alone.size(); ++b) m.pairs.push_back(pair_of(request, m.alone, a, b));
  conclude(m);
  sim::write_whole(m.out + "/report.html", together_page(m), true);
  sim::write_whole(m.out + "/together.json", together_json(m), true);
  follower.tell("");
  for (const std::string& sentence : m.answer) follower.tell(sentence);
  follower.tell(m.out + "/report.html");
  return m;
}

}  // namespace vegard::fit
