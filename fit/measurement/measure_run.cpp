#include "fit/measurement/measure_run.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "fit/measurement/sky_light.h"
#include "fit/photo/frames/frame_name.h"
#include "fit/photo/scene_photos.h"
#include "fit/ready_scene.h"
#include "fit/report/map_run.h"
#include "fit/search/file_journal.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/utc_time.h"
#include "sim/base/version.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::fit {
namespace {

namespace fs = std::filesystem;

int exit_code_of(sim::ErrorKind kind) {
  switch (kind) {
    case sim::ErrorKind::unreadable_input:
      return 3;
    case sim::ErrorKind::unwritable_output:
      return 6;
    default:
      return 2;
  }
}

/// What measure.json says until the measurement has an answer.
std::string unfinished_json(const Measurement& m) {
  const nlohmann::ordered_json json = {{"kind", "vegard measure"},
                                       {"version", sim::version()},
                                       {"command", m.command},
                                       {"photo", m.photo},
                                       {"interrupted", true}};
  return json_line(json) + "\n";
}

bool is_input(const MeasureRequest& request, const std::string& name) {
  std::error_code ignored;
  for (const std::string& input : {file_of_frame(request.photo), request.camera, request.mask})
    if (!input.empty() && fs::equivalent(name, input, ignored)) return true;
  return false;
}

}  // namespace

bool is_interrupted_measurement(const std::string& json_file) {
  constexpr std::size_t kLargest = 1 << 24;
  const nlohmann::json json =
      nlohmann::json::parse(sim::read_input(json_file, kLargest).bytes, nullptr, false);
  return json.is_object() && json.value("interrupted", nlohmann::json(false)) == nlohmann::json(true);
}

void remove_earlier_map(const std::string& folder, const std::vector<MeasureRequest>& requests) {
  std::error_code failed;
  const std::string map = folder + "/map", journal = journal_file(map), scene = folder + "/scene.toml";
  if (fs::exists(journal, failed)) FileJournal(journal, {}, JournalMode::overwrite).remove();
  if (fs::exists(map, failed)) {
    check_map_directory(map, true);
    fs::remove_all(map, failed);
  }
  if (std::none_of(requests.begin(), requests.end(),
                   [&](const MeasureRequest& request) { return is_input(request, scene); }))
    fs::remove(scene, failed);
}

double as_written(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::string json_line(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string site_text(const sim::Observer& site) {
  return fmt::format("{:.10g},{:.10g},{:.10g}", site.latitude_deg, site.longitude_deg, site.height_m);
}

MeasureRun::MeasureRun(const MeasureRequest& asked, const MeasureFollower& heard)
    : request(asked), follower(heard) {
  result.command = request.command;
  result.photo = fs::path(request.photo).filename().string();
  result.out = request.out.empty() ? stem_of_picture(request.photo) + "_measured" : request.out;
}

void MeasureRun::read_given() {
  if (!request.time.empty()) {
    const std::optional<double> seconds = sim::utc_seconds(request.time);
    if (!seconds)
      throw usage_error("--time", "'" + request.time + "' is no time",
                        "ISO 8601 such as 2014-02-21T19:30:40Z, or with a zone, 2014-02-21T20:30:40+01:00");
    result.time_utc = sim::utc_text(*seconds);
  }
  result.site = request.site;
  metadata_with_size(request.photo);  // throws if there is no picture
  if (request.camera.empty()) return;
  const sim::Scene scene = sim::read_scene(request.camera);
  if (!result.site && scene.lines.count("site.latitude_deg") + scene.lines.count("site.longitude_deg") == 2)
    result.site = sim::Observer{scene.site.latitude_deg, scene.site.longitude_deg, scene.site.altitude_m};
}

void MeasureRun::claim_folder() const {
  std::error_code failed;
  const std::string& out = result.out;
  const bool is_there = fs::exists(out, failed);
  if (is_there && !fs::is_directory(out, failed))
    throw sim::Error(sim::ErrorKind::existing_output, "is no folder").file(out);
  const bool is_resumed = request.resume && is_interrupted_measurement(in_run("measure.json"));
  if (is_there && !fs::is_empty(out, failed) && !request.overwrite && !is_resumed)
    throw sim::Error(sim::ErrorKind::existing_output,
                     request.resume
                         ? "is no interrupted measurement (--overwrite replaces what vegard wrote there)"
                         : "exists already (--overwrite replaces what vegard wrote there)")
        .file(out);
  if (is_there && !fs::is_empty(out, failed) && !fs::exists(in_run("measure.json")) &&
      !fs::exists(in_run("mask.png")))
    throw sim::Error(sim::ErrorKind::existing_output, "holds something that is no measurement").file(out);
  // Of several pictures the claim of their common folder did this, which knows whether they are resumed.
  if (!is_resumed && !request.keep_journal) remove_earlier_map(out, {request});
  fs::create_directories(out, failed);
  if (failed)
    throw sim::Error(sim::ErrorKind::unwritable_output, "cannot be made: " + failed.message()).file(out);
  // Until there is an answer: an interrupted measurement is one as well.
  write("measure.json", unfinished_json(result));
}

MeasureStage& MeasureRun::begin(const std::string& title) {
  follower.tell("");
  follower.tell(title);
  result.stages.emplace_back();
  result.stages.back().title = title;
  return result.stages.back();
}

MeasureRun::Words MeasureRun::with_common(Words words) const {
  if (!request.decoding.empty()) words.insert(words.end(), {"--decoding", request.decoding});
  words.push_back("--overwrite");
  return words;
}

MeasureRun::Words MeasureRun::with_site(Words words) const {
  for (const auto& [path, value] : changes_of_site())
    words.insert(words.end(), {"--set", path + "=" + value});
  return words;
}

std::vector<std::pair<std::string, std::string>> MeasureRun::changes_of_site() const {
  if (!result.site) return {};
  return {{"site.latitude_deg", sim::real_text(result.site->latitude_deg)},
          {"site.longitude_deg", sim::real_text(result.site->longitude_deg)},
          {"site.altitude_m", sim::real_text(result.site->height_m)}};
}

std::vector<PhotoFact> MeasureRun::make_scene_ready(sim::Scene& scene, const Tell& tell) const {
  std::set<std::string> changed;
  for (const auto& [path, value] : changes_of_site()) {
    sim::set_from_text(scene, path, value);
    changed.insert(path);
  }
  make_ready(scene);
  scene.fit.photos.clear();  // the photograph is the command line's, the camera and the site the scene's
  return take_from_photograph(scene, request.photo, changed, tell);
}

Decoding MeasureRun::decoding() const {
  return decoding_of_word(request.decoding.empty() ? "auto" : request.decoding);
}

void MeasureRun::write(const std::string& name, const std::string& bytes) const {
  if (is_input(request, in_run(name)))
    throw sim::Error(sim::ErrorKind::usage, "'" + in_run(name) + "' is an input as well")
        .key("--output")
        .hint("choose another name");
  sim::write_whole(in_run(name), bytes, true);
}

void MeasureRun::write(MeasureStage& stage, const std::string& name, const std::string& bytes,
                       const Tell& tell) const {
  write(name, bytes);
  stage.files.push_back(name);
  tell(in_run(name));
}

std::vector<PixelPoint> MeasureRun::skyline() const {
  std::vector<PixelPoint> points;
  if (!result.sky || !result.sky->skyline) return points;
  for (const double y_px : result.sky->skyline->horizon.y_px)
    points.push_back({static_cast<double>(points.size()) + 0.5, y_px});
  return points;
}

void MeasureRun::show_command(MeasureStage& stage, const Words& words) const {
  stage.command = "vegard";
  for (const std::string& word : words) stage.command += " " + sim::quoted_for_shell(word);
  stage.words.clear();
  stage.exit_code = kStageGood;
  follower.tell("$ " + stage.command);
}

void MeasureRun::end_with(MeasureStage& stage, const sim::Error& error, const Tell& tell) {
  if (error.kind() == sim::ErrorKind::unwritable_output || error.kind() == sim::ErrorKind::existing_output)
    throw;  // no stage will do better
  stage.exit_code = exit_code_of(error.kind());
  stage.found = error.what();
  tell(error.what());
}

}  // namespace vegard::fit
