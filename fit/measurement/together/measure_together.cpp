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
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/sha256.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace together {

namespace fs = std::filesystem;

constexpr double kToldExposures_s = 0.5;  ///< half the difference

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

std::string border_sentence(const PairHeight& height, const PairOfPictures& pair) {
  const std::string by = height.is_by_profiles ? "the light along the field lines"
                                               : fmt::format("{} points of the border", height.points);
  return fmt::format(
      "The lower border is {} km high by geometry alone (by {} in both pictures; {:.0f} km between the "
      "cameras).",
      sim::number_with_error(height.km, height.error_km), by, pair.base_km);
}

/// "It is 131 ± 3 km from the first camera."
std::string distance_sentence(const PairHeight& height, const PairOfPictures& pair,
                              const std::vector<Measurement>& alone) {
  const BorderDistance first = distance_by(pair, height, alone[pair.first], 0),
                       second = distance_by(pair, height, alone[pair.second], 1);
  if (!std::isfinite(first.km) || !std::isfinite(second.km)) return {};
  return fmt::format("Its nearest part is {} km from the first camera, and {} km from the second.",
                     sim::number_with_error(first.km, first.error_km),
                     sim::number_with_error(second.km, second.error_km));
}

/// What all pictures say of their clocks, by the pairs whose light along the field lines is sound.
ClockSolution clocks_of(const TogetherMeasurement& m, const TogetherRequest& request) {
  std::vector<MovedPair> moved;
  for (const PairOfPictures& pair : m.pairs)
    if (has_sound_profiles(pair)) moved.push_back(moved_pair(pair));
  return clock_solution(m.alone.size(), moved, request.clock_error_s, request.drift_km_s);
}

/// What a pair says of heights; none if it is refused or has none.
std::vector<std::string> sentences_of(const PairOfPictures& pair, const std::optional<PairHeight>& height,
                                      const std::vector<Measurement>& alone) {
  std::vector<std::string> said;
  if (height) {
    said.push_back(border_sentence(*height, pair));
    for (const std::string& doubt : height->doubts) said.push_back("With care: " + doubt + ".");
    if (const std::string distance = distance_sentence(*height, pair, alone); !distance.empty())
      said.push_back(distance);
    if (const std::optional<PairHeight> peak = peak_of(pair))
      said.push_back(fmt::format("The light along the field lines is brightest {} km high.",
                                 sim::number_with_error(peak->km, peak->error_km)));
  } else {
    said.push_back(pair.borders.along_epipolar > 0
                       ? "The height of the border is not known, it runs along the line between the cameras."
                       : "The height of the border is not known, no border of one picture is in the other.");
  }
  if (height && pair.exposures_s >= kToldExposures_s)
    said.push_back(fmt::format(
        "The exposures differ by {:.0f} s as far as they are known: the errors allow for light that moves "
        "meanwhile.",
        2.0 * pair.exposures_s));
  if (const ShellHeight* pattern = clear_pattern(pair))
    said.push_back(fmt::format("The densest light is {} km high (correlation {:.2f}).",
                               sim::number_with_error(pattern->km, pattern->error_km), pattern->correlation));
  return said;
}

void conclude(TogetherMeasurement& m) {
  std::vector<PairHeight> good;
  bool has_height = false;
  for (const PairOfPictures& pair : m.pairs) {
    const std::string names = m.alone[pair.first].photo + " and " + m.alone[pair.second].photo;
    if (!pair.refusal.empty()) {
      m.answer.push_back(names + ": no height, " + pair.refusal + ".");
      continue;
    }
    const std::optional<PairHeight> height = height_of(pair);
    has_height = has_height || height || clear_pattern(pair);
    if (height && height->doubts.empty()) good.push_back(*height);
    std::vector<std::string> said = sentences_of(pair, height, m.alone);
    if (m.pairs.size() > 1) said.front() = names + ": " + said.front();
    m.answer.insert(m.answer.end(), said.begin(), said.end());
  }
  m.common_border = common_border(m.pairs, m.clocks);
  if (m.common_border) {
    m.answer.push_back(fmt::format("By all pictures together the lower border is {} km high.",
                                   sim::number_with_error(m.common_border->km, m.common_border->error_km)));
    for (const std::string& doubt : m.common_border->doubts) m.answer.push_back("With care: " + doubt + ".");
  }
  const bool is_contradicted = contradict(good);
  if (is_contradicted)
    m.answer.push_back("With care: the heights of the pairs contradict each other beyond their errors.");
  const bool is_good = !good.empty() && !is_contradicted;
  m.trust = is_good ? Trust::good : has_height ? Trust::doubtful : Trust::unconstrained;
  m.word = is_good ? "Measured" : has_height ? "With care" : "No height";
}

}  // namespace together

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
  m.clocks = clocks_of(m, request);
  conclude(m);
  sim::write_whole(m.out + "/report.html", together_page(m), true);
  sim::write_whole(m.out + "/together.json", together_json(m), true);
  follower.tell("");
  for (const std::string& sentence : m.answer) follower.tell(sentence);
  follower.tell(m.out + "/report.html");
  return m;
}

}  // namespace vegard::fit
