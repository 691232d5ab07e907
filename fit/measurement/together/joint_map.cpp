#include "fit/measurement/together/joint_map.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "fit/answer/input_files.h"
#include "fit/measurement/measure_stages.h"
#include "fit/measurement/sky_light.h"
#include "fit/photo/scene_photos.h"
#include "fit/ready_scene.h"
#include "fit/report/map_run.h"
#include "fit/search/file_journal.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/sha256.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/shown_text.h"
#include "sim/base/text.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/decoding_word.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::fit {
namespace joint_map {

namespace fs = std::filesystem;

// A map's distance is that of the feet at 110 km, beside which the border of an inclined field line stands.
constexpr double kFoot_km = 3.0;
constexpr const char* kFlux = "energy flux";            // of a verdict
constexpr double kContradiction = 2.0;                  // in standard errors of the difference
constexpr std::size_t kAllSetsTried = 20;               // pictures; their sets are a million
constexpr double kMoved = 3.0, kLongestMoved_km = 3.0;  // how clearly, and how far

/// Whether the light has moved between the pictures as they show it: one map does not explain both then.
bool has_moved(const PairOfPictures& pair) {
  if (!has_clear_profiles(pair)) return false;
  const double moved_km = std::abs(pair.profiles.across_km);
  return moved_km > kLongestMoved_km && moved_km > kMoved * std::sqrt(pair.profiles.covariance_km2(1, 1));
}

/// Why two pictures are in no map together; empty: they may be.
std::string why_not_together(const PairOfPictures& pair, const std::vector<Measurement>& alone,
                             const std::vector<std::string>& lacking) {
  if (!pair.refusal.empty()) return pair.refusal;
  if (has_moved(pair))
    return fmt::format("the light has moved by {} km between the pictures",
                       sim::number_with_error(std::abs(pair.profiles.across_km),
                                              std::sqrt(pair.profiles.covariance_km2(1, 1))));
  for (const std::size_t i : {pair.first, pair.second})
    if (!alone[i].main_border) return "no border in " + alone[i].photo + " is claimed to be aurora's";
  for (const std::size_t i : {pair.first, pair.second})
    if (!lacking[i].empty()) return alone[i].photo + " has none (" + lacking[i] + ")";
  return {};
}

/// Tries all sets of pictures, each of which may be with every other, that begin with those chosen, and keeps
/// the first of the largest.
void try_sets(std::vector<std::size_t>& chosen, std::size_t next, const std::vector<std::vector<bool>>& may,
              std::vector<std::size_t>& most) {
  if (chosen.size() > most.size()) most = chosen;
  for (std::size_t i = next; i < may.size() && chosen.size() + may.size() - i > most.size(); ++i) {
    if (!std::all_of(chosen.begin(), chosen.end(), [&](std::size_t c) { return may[c][i]; })) continue;
    chosen.push_back(i);
    try_sets(chosen, i + 1, may, most);
    chosen.pop_back();
  }
}

/// The most pictures each of which may be with every other; of as many the earlier ones. Of more than
/// kAllSetsTried pictures it may be fewer than the most: only one set from each picture on is tried.
std::vector<std::size_t> most_together(std::size_t count, const std::vector<std::vector<bool>>& may) {
  std::vector<std::size_t> most, none;
  if (count <= kAllSetsTried) {
    try_sets(none, 0, may, most);
    return most;
  }
  for (std::size_t first = 0; first < count; ++first) {
    std::vector<std::size_t> chosen = {first};
    for (std::size_t i = 0; i < count; ++i)
      if (i != first && std::all_of(chosen.begin(), chosen.end(), [&](std::size_t c) { return may[c][i]; }))
        chosen.push_back(i);
    if (chosen.size() > most.size()) most = chosen;
  }
  std::sort(most.begin(), most.end());
  return most;
}

/// The better of two pairs' heights to compare a map with is the greater.
int rank_of(const PairOfPictures& pair) {
  const std::optional<PairHeight> height = height_of(pair);
  return !height ? 0 : !height->doubts.empty() ? 1 : 2;
}

/// A file as a scene in `folder` names it.
std::string seen_from(const std::string& folder, const std::string& file) {
  std::error_code failed;
  const fs::path relative =
      fs::relative(fs::absolute(file), fs::weakly_canonical(fs::absolute(folder)), failed);
  return failed || relative.empty() ? fs::absolute(file).string() : relative.string();
}

/// The decoding of a picture as an entry of the scene has it, whose curve is a file beside the scene.
std::string decoding_word_for(const std::string& word, const std::string& folder) {
  return sim::starts_with(word, std::string(sim::kCurveWord))
             ? std::string(sim::kCurveWord) + seen_from(folder, word.substr(sim::kCurveWord.size()))
             : word;
}

/// Adds those values of a table ("camera.") in which the picture's own scene differs from that of all.
void add_values(const sim::Scene& of_all, const sim::Scene& own, const std::string& table,
                sim::PhotoEntry& entry) {
  for (const sim::ParameterPath& path : sim::all_paths(own))
    if (sim::starts_with(path.text, table) && sim::value_text(own, path) != sim::value_text(of_all, path))
      entry.set.emplace_back(path.text, sim::value_text(own, path));
}

/// The scene of the picture's map alone, with its camera and place.
sim::Scene scene_alone(const MeasureRun& run) {
  sim::Scene scene = sim::read_scene(run.in_run("scene.toml"));
  scene.camera = *run.result.camera;
  scene.site.latitude_deg = run.result.site->latitude_deg;
  scene.site.longitude_deg = run.result.site->longitude_deg;
  scene.site.altitude_m = run.result.site->height_m;
  return scene;
}

}  // namespace joint_map

JointMap planned_map(const std::vector<PairOfPictures>& pairs, const std::vector<Measurement>& alone,
                     const std::vector<std::string>& lacking) {
  using namespace joint_map;
  JointMap map;
  std::vector<std::vector<bool>> may(alone.size(), std::vector<bool>(alone.size(), false));
  std::vector<PairHeight> good;
  std::string why;
  for (const PairOfPictures& pair : pairs) {
    const std::string problem = why_not_together(pair, alone, lacking);
    if (why.empty()) why = problem;
    may[pair.first][pair.second] = may[pair.second][pair.first] = problem.empty();
    if (rank_of(pair) == 2 && pair.refusal.empty()) good.push_back(*height_of(pair));
  }
  map.pictures = most_together(alone.size(), may);
  if (contradict(good)) why = "the heights of the pairs contradict each other";
  if (map.pictures.size() < 2 || contradict(good)) {
    map.pictures.clear();
    map.missing = why;
    return map;
  }
  int best = -1;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    if (!may[pairs[p].first][pairs[p].second] || rank_of(pairs[p]) <= best) continue;
    const auto in_map = [&](std::size_t i) {
      return std::find(map.pictures.begin(), map.pictures.end(), i) != map.pictures.end();
    };
    if (!in_map(pairs[p].first) || !in_map(pairs[p].second)) continue;
    best = rank_of(pairs[p]);
    map.pair = p;
  }
  map.home = pairs[map.pair].first;
  return map;
}

std::string scene_of_joint_map(const JointMap& map, const std::deque<MeasureRun>& pictures,
                               const std::string& folder) {
  using namespace joint_map;
  sim::Scene scene = scene_alone(pictures[map.home]);
  scene.camera = {};
  for (const std::size_t i : map.pictures) {
    const MeasureRun& run = pictures[i];
    const sim::Scene own = scene_alone(run);
    sim::PhotoEntry entry;
    entry.name = fmt::format("picture_{}", i + 1);
    entry.file = seen_from(folder, run.request.photo);
    entry.mask = seen_from(folder, run.in_run("mask.png"));
    entry.decoding = decoding_word_for(run.request.decoding, folder);
    for (const char* table : {"site.", "camera.", "blur."}) add_values(scene, own, table, entry);
    scene.fit.photos.push_back(std::move(entry));
  }
  return sim::write_scene(scene, "For vegard map, by vegard measure of several photographs.");
}

void make_joint_map(JointMap& map, const std::deque<MeasureRun>& pictures, const PairOfPictures& pair,
                    const std::string& folder, const MeasureFollower& follower) {
  using namespace joint_map;
  const std::string file = folder + "/scene.toml", out = folder + "/map";
  const MeasureRequest& request = pictures[map.pictures.front()].request;
  map.command = fmt::format("vegard map {} --out {} --replicates {} --threads {} --overwrite",
                            sim::quoted_for_shell(file), sim::quoted_for_shell(out), request.replicates,
                            request.threads);
  follower.tell("$ " + map.command);
  try {
    sim::write_whole(file, scene_of_joint_map(map, pictures, folder), true);
    sim::Scene scene = sim::read_scene(file);
    make_ready(scene);
    const std::vector<Photo> photos = photographs_of(scene);
    check_map_directory(out, true);
    MapOptions options;
    options.threads = request.threads;
    options.replicates = request.replicates;
    FileJournal journal(journal_file(out), subject_of_map(options, scene, photos),
                        request.resume ? JournalMode::resume : JournalMode::overwrite);
    if (follower.map_begins) follower.map_begins(options);
    const PhotoMap made = mapped_photos(scene, photos, std::move(options), journal);
    MapRunFacts facts;
    facts.command = map.command;
    facts.inputs = inputs_of(file, sim::sha256_of_file(file), photos);
    write_map(made, photos, out, true, facts, follower.tell);
    map.is_interrupted = made.result.interrupted;
    map.is_good = std::all_of(made.verdicts.begin(), made.verdicts.end(), [](const QuantityVerdict& v) {
      return v.trust == Trust::good || sim::starts_with(v.quantity, kFlux);
    });
    map.chi2_per_value = made.result.chi2_per_value();
    const Measurement& home = pictures[map.home].result;
    const auto trace = compared_trace(pair, home, 0);
    if (!trace || map.is_interrupted) return;
    map.curtain = main_curtain(made.result, made.curtains, home.border->traces[*trace], *home.border_scene);
    if (map.curtain)
      map.nearest_km = nearest_by(*map.curtain, placed_border(*home.border, *trace, *home.border_scene));
  } catch (const MapStopped&) {
    map.is_interrupted = true;
  } catch (const sim::Error& error) {
    if (error.kind() == sim::ErrorKind::unwritable_output || error.kind() == sim::ErrorKind::existing_output)
      throw;
    follower.tell(error.what());
    map.missing = error.details().problem;
  }
}

WithError nearest_by(const MainCurtain& curtain, const MainBorder& border) {
  if (!curtain.is_along_border) return {sim::kNaN, sim::kNaN};
  const double factor = border.distance_km / curtain.border_distance_km.value;
  return {curtain.distance_km.value * factor, curtain.distance_km.error * factor};
}

std::vector<Contradiction> contradictions(const JointMap& map, const PairHeight& height,
                                          const BorderDistance& distance) {
  std::vector<Contradiction> found;
  if (!map.curtain) return found;
  const auto compare = [&](const char* quantity, const WithError& geometry, const WithError& by_map,
                           double more_km) {
    const double error = std::hypot(geometry.error, by_map.error, more_km);
    if (!std::isfinite(error)) return;  // without error bars nothing can be said
    if (std::abs(geometry.value - by_map.value) > joint_map::kContradiction * error)
      found.push_back({quantity, geometry, by_map});
  };
  compare("height of the lower border", {height.km, height.error_km}, map.curtain->lower_border_km, 0.0);
  if (std::isfinite(map.nearest_km.value) && std::isfinite(distance.km))
    compare("distance", {distance.km, distance.error_km}, map.nearest_km, joint_map::kFoot_km);
  return found;
}

}  // namespace vegard::fit
