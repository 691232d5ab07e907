#include "fit/measurement/together/measure_together.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "fit/measurement/main_border.h"
#include "fit/measurement/measure_run.h"
#include "fit/measurement/measure_stages.h"
#include "fit/photo/frames/frame_name.h"
#include "fit/search/file_journal.h"
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
  bool is_resumed = false;
  if (is_there && !fs::is_directory(request.out, failed))
    throw sim::Error(sim::ErrorKind::existing_output, "is no folder").file(request.out);
  if (is_there && !fs::is_empty(request.out, failed)) {
    is_resumed = request.resume && is_interrupted_measurement(request.out + "/together.json");
    if (request.resume && !request.overwrite && !is_resumed)
      throw sim::Error(sim::ErrorKind::existing_output,
                       "is no interrupted measurement (--overwrite replaces what vegard wrote there)")
          .file(request.out);
    if (!request.overwrite && !is_resumed) throw sim::already_exists(request.out);
    if (!fs::exists(request.out + "/together.json"))
      throw sim::Error(sim::ErrorKind::existing_output,
                       "holds something that is no measurement of several pictures")
          .file(request.out);
  }
  // What an earlier measurement has left would seem to be of this one: maps, and more pictures.
  if (!is_resumed) {
    remove_earlier_map(request.out, request.pictures);
    for (std::size_t i = 0; i < request.pictures.size(); ++i)
      remove_earlier_map(folder_of(request, i), request.pictures);
  }
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

/// "the lower border 98 ± 3 km high and its nearest part 131 ± 4 km away, with electrons of 4.1 ± 0.3 keV"
std::string curtain_words(const MainCurtain& c, const WithError& nearest_km) {
  const std::string away = std::isfinite(nearest_km.value)
                               ? fmt::format(" and its nearest part {} km away",
                                             sim::number_with_error(nearest_km.value, nearest_km.error))
                               : "";
  return fmt::format("the lower border {} km high{}, with electrons of {} keV",
                     sim::number_with_error(c.lower_border_km.value, c.lower_border_km.error), away,
                     sim::number_with_error(c.energy_kev.value, c.energy_kev.error));
}

/// What the map of all pictures says, and what it and the geometry contradict each other in.
void conclude_map(TogetherMeasurement& m) {
  if (!m.joint_map) return;
  const JointMap& map = *m.joint_map;
  if (map.is_interrupted) {
    m.answer.push_back("The map of all pictures was interrupted; the same command with --resume goes on.");
  } else if (!map.missing.empty()) {
    m.answer.push_back("There is no map of all pictures: " + map.missing + ".");
  } else if (!map.curtain) {
    m.answer.push_back("The map of all pictures has no curtain whose lower border is in view.");
  } else {
    const Measurement& home = m.alone[map.home];
    m.answer.push_back(fmt::format("One map of {} pictures puts {}{}{}.", map.pictures.size(),
                                   curtain_words(*map.curtain, map.nearest_km),
                                   map.home == 0 ? "" : " (from " + home.photo + ")",
                                   map.is_good ? "" : ", with care"));
    const bool is_same_border =
        home.main_border && compared_trace(m.pairs[map.pair], home, 0) == home.main_border->trace;
    if (home.main_curtain && is_same_border)
      m.answer.push_back(
          "Alone, " + home.photo + " has " +
          curtain_words(*home.main_curtain, nearest_by(*home.main_curtain, *home.main_border)) + ".");
  }
  if (map.missing.empty())
    for (const std::string& picture : map.left_out)
      m.answer.push_back("The map of all pictures is without " + picture + ".");
  if (m.is_map_interrupted && !map.is_interrupted)
    m.answer.push_back(
        "The map of one picture alone was interrupted; the same command with --resume goes on.");
  const std::optional<PairHeight> height = compared_height(m);
  if (map.curtain && height)
    m.contradictions =
        contradictions(map, *height, distance_by(m.pairs[map.pair], *height, m.alone[map.home], 0));
  for (const Contradiction& c : m.contradictions)
    m.answer.push_back(
        fmt::format("{} {} is {} km by geometry and {} km by the map, beyond two standard errors.",
                    map.is_good ? "With care: the" : "The map is doubtful: the", c.quantity,
                    sim::number_with_error(c.geometry_km.value, c.geometry_km.error),
                    sim::number_with_error(c.map_km.value, c.map_km.error)));
}

/// The answer by what is there up to now.
void conclude(TogetherMeasurement& m) {
  m.answer.clear();
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
  conclude_map(m);
  const bool is_denied = m.joint_map && m.joint_map->is_good && !m.contradictions.empty();
  const bool is_good = !good.empty() && !is_contradicted && !is_denied;
  m.trust = is_good ? Trust::good : has_height ? Trust::doubtful : Trust::unconstrained;
  m.word = is_good ? "Measured" : has_height ? "With care" : "No height";
}

/// The requests of the single pictures, each with its folder.
std::deque<MeasureRequest> requests_alone(const TogetherRequest& request) {
  std::deque<MeasureRequest> alone;
  for (std::size_t i = 0; i < request.pictures.size(); ++i) {
    alone.push_back(request.pictures[i]);
    alone.back().out = folder_of(request, i);
    alone.back().overwrite = alone.back().keep_journal = alone.back().reference_field = true;
    alone.back().no_map = request.no_map;
    alone.back().resume = request.resume;
    alone.back().command = request.command;
  }
  return alone;
}

void write_pages(const TogetherMeasurement& m) {
  sim::write_whole(m.out + "/report.html", together_page(m), true);
  sim::write_whole(m.out + "/together.json", together_json(m), true);
}

/// The plan of the map of all pictures, of each of which its part is prepared. One of which that cannot be is
/// left out: the others may have a map without it.
JointMap prepared_map(const TogetherMeasurement& m, std::deque<MeasureRun>& runs,
                      const MeasureFollower& follower) {
  std::vector<std::string> lacking(runs.size()), left_out;
  std::vector<bool> is_prepared(runs.size(), false);
  JointMap map = planned_map(m.pairs, m.alone, lacking);
  for (std::size_t k = 0; k < map.pictures.size();) {
    const std::size_t i = map.pictures[k++];
    if (is_prepared[i]) continue;
    MeasureRun& run = runs[i];
    follower.tell("");
    follower.tell(run.result.photo);
    lacking[i] = prepare_map(run);
    is_prepared[i] = lacking[i].empty();
    if (is_prepared[i]) continue;
    conclude_measurement(run);
    left_out.push_back(run.result.photo + ": " + lacking[i]);
    map = planned_map(m.pairs, m.alone, lacking);
    k = 0;
  }
  map.left_out = std::move(left_out);
  return map;
}

/// The map of all pictures, and those of each alone.
void add_maps(TogetherMeasurement& m, std::deque<MeasureRun>& runs, const MeasureFollower& follower) {
  JointMap map = prepared_map(m, runs, follower);
  follower.tell("");
  follower.tell("The map of all pictures");
  if (map.missing.empty()) {
    m.is_map_interrupted = true;  // until it is not
    write_pages(m);
    make_joint_map(map, runs, m.pairs[map.pair], m.out, follower);
    m.is_map_interrupted = map.is_interrupted;
  }
  for (const std::size_t i : map.pictures) {
    MeasureRun& run = runs[i];
    if (m.is_map_interrupted || !map.missing.empty()) break;
    follower.tell("");
    follower.tell(run.result.photo + " alone");
    finish_map(run);
    conclude_measurement(run);
    m.is_map_interrupted = run.result.is_map_interrupted;
  }
  m.joint_map = std::move(map);
}

/// The finished maps have nothing left to go on with.
void remove_journals(const TogetherMeasurement& m) {
  std::error_code ignored;
  fs::remove(journal_file(m.out + "/map"), ignored);
  for (const Measurement& one : m.alone) fs::remove(journal_file(one.out + "/map"), ignored);
}

}  // namespace together

std::optional<PairHeight> compared_height(const TogetherMeasurement& m) {
  return m.common_border ? m.common_border : height_of(m.pairs[m.joint_map->pair]);
}

TogetherMeasurement measure_together(const TogetherRequest& request, const MeasureFollower& follower) {
  using namespace together;
  check_inputs(request, follower);
  refuse_same_pictures(request);
  claim_folder(request);
  TogetherMeasurement m;
  m.command = request.command;
  m.out = request.out;
  const std::deque<MeasureRequest> requests = requests_alone(request);
  std::deque<MeasureRun> runs;
  for (const MeasureRequest& picture : requests) {
    follower.tell("");
    follower.tell("Picture " + std::to_string(runs.size() + 1) + ": " + picture.photo);
    MeasureRun& run = runs.emplace_back(picture, follower);
    run.read_given();
    run.claim_folder();
    measure_before_map(run);
    conclude_measurement(run);
    m.alone.push_back(run.result);
  }
  for (std::size_t a = 0; a < m.alone.size(); ++a)
    for (std::size_t b = a + 1; b < m.alone.size(); ++b) m.pairs.push_back(pair_of(request, m.alone, a, b));
  m.clocks = clocks_of(m, request);
  conclude(m);
  if (!request.no_map) {
    follower.tell("");
    for (const std::string& sentence : m.answer) follower.tell(sentence);
    add_maps(m, runs, follower);
    for (std::size_t i = 0; i < runs.size(); ++i) m.alone[i] = std::move(runs[i].result);
    conclude(m);
  }
  write_pages(m);
  if (!m.is_map_interrupted) remove_journals(m);
  follower.tell("");
  for (const std::string& sentence : m.answer) follower.tell(sentence);
  follower.tell(m.out + "/report.html");
  return m;
}

}  // namespace vegard::fit
