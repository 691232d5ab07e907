#include "fit/survey/survey.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"
#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/decoding_word.h"
#include "sim/scene/table/bounded_toml.h"
#include "sim/scene/table/checked_table.h"

namespace vegard::fit {
namespace {

using sim::Origin;
using sim::scene_error;

constexpr double kMaxSeconds = 1e6;

using SurveyTable = sim::CheckedTable;

SurveyPeriod period_of(SurveyTable& table) {
  SurveyPeriod period;
  table.time("from", period.from_s);
  table.time("until", period.until_s);
  if (!(period.from_s < period.until_s))
    throw scene_error({"the period ends before it begins", "a time after 'from'", ""}, table.at("until"));
  return period;
}

std::string plain_name(SurveyTable& table, const std::string& key) {
  const std::string expected = "letters, digits, _ and -, 64 at most";
  std::string name = table.text(key, expected);
  if (name.empty()) throw scene_error({"'" + key + "' is missing", expected, ""}, table.at(key));
  if (!is_plain_name(name)) throw scene_error({"'" + name + "' is no name", expected, ""}, table.at(key));
  return name;
}

void read_head(SurveyTable& table, Survey& survey, std::string& scene) {
  survey.name = plain_name(table, "name");
  const std::string works = "an array of \"filter\", \"border\", \"profile\", \"fit\" and \"map\"";
  for (const std::string& word : table.texts("work", works)) {
    const std::optional<SurveyWork> work = survey_work_of(word);
    if (!work) throw scene_error({"'" + word + "' is no work", works, ""}, table.at("work"));
    if (std::find(survey.work.begin(), survey.work.end(), *work) != survey.work.end())
      throw scene_error({"'" + word + "' is listed twice", works, ""}, table.at("work"));
    survey.work.push_back(*work);
  }
  if (survey.work.empty())
    throw scene_error({"it is not said what to do with a frame", works, ""}, table.at("work"));
  std::sort(survey.work.begin(), survey.work.end());
  scene = table.text("scene");
  table.whole_number("block_frames", 1, 1000000, survey.block_frames);
  table.number("gap_s", 0.0, kMaxSeconds, survey.gap_s);
  table.number("shard_minutes", 0.0, kMaxSeconds, survey.shard_minutes);
  table.whole_number("max_shards", 1, 100000, survey.max_shards);
  survey.cost_s = kSurveyCost_s;
  table.table("cost_s", [&](SurveyTable& costs) {
    for (std::size_t w = 0; w < kSurveyWorks.size(); ++w)
      costs.number(survey_work_name(kSurveyWorks[w]), 0.0, kMaxSeconds, survey.cost_s[w]);
  });
}

void check_periods(const SurveyTable& table, const SurveyCamera& camera) {
  for (std::size_t i = 0; i < camera.calibrations.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const SurveyPeriod &a = camera.calibrations[j].period, &b = camera.calibrations[i].period;
      if (a.from_s < b.until_s && b.from_s < a.until_s)
        throw scene_error({"calibrations " + std::to_string(j + 1) + " and " + std::to_string(i + 1) +
                               " of '" + camera.name + "' are for the same time",
                           "periods (from, until) that do not overlap", ""},
                          table.at("calibration"));
    }
}

SurveyCamera read_camera(SurveyTable& table, const std::string& scene) {
  SurveyCamera camera;
  camera.line = table.line();
  camera.name = plain_name(table, "name");
  camera.scene = table.text("scene");
  if (camera.scene.empty()) camera.scene = scene;
  camera.changes = table.texts("set", "an array of texts, \"path=value\"");
  const std::string frames = "an array of folders, lists (.txt) and files, in quotes";
  camera.frames = table.texts("frames", frames);
  if (camera.frames.empty())
    throw scene_error({"camera '" + camera.name + "' has no frames", frames, ""}, table.at("frames"));
  camera.endings = table.texts("endings", "an array of endings of file names, \".png\"");
  for (std::string& ending : camera.endings)
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (camera.endings.empty()) camera.endings = picture_endings();
  double start_s = NAN;
  table.time("start", start_s);
  if (std::isfinite(start_s)) camera.start_s = start_s;
  constexpr double kLeastStep_s = 1e-4;
  double step_s = NAN;
  table.number("step_s", kLeastStep_s, kMaxSeconds, step_s);
  if (std::isfinite(step_s)) camera.step_s = step_s;
  if (camera.step_s > 0.0 && !camera.start_s)
    throw scene_error({"frames follow each other from no time", "'start' with it", ""}, table.at("step_s"));
  camera.decoding = table.text("decoding");
  if (const auto complaint = sim::decoding_complaint(camera.decoding); complaint && !camera.decoding.empty())
    throw scene_error(*complaint, table.at("decoding"));
  const std::string channel = table.text("channel");
  const std::vector<std::string> channels = {"red", "green", "blue"};
  if (!channel.empty()) {
    const auto found = std::find(channels.begin(), channels.end(), channel);
    if (found == channels.end())
      throw scene_error({"'" + channel + "' is no channel", "red, green or blue", ""}, table.at("channel"));
    camera.channel = static_cast<int>(found - channels.begin());
  }
  camera.filter = table.text("filter", "a file of scripts/learn_sky_kind.py");
  table.each("calibration", [&](SurveyTable& inner) {
    SurveyCalibration calibration;
    calibration.period = period_of(inner);
    calibration.file = inner.text("file");
    calibration.mask = inner.text("mask");
    if (calibration.file.empty() && calibration.mask.empty())
      throw scene_error({"a calibration without 'file' and 'mask' says nothing", "file = \"camera.toml\"",
                         "vegard calibrate writes such files"},
                        inner.at("file"));
    if (calibration.file.empty() && camera.scene.empty())
      throw scene_error({"there is neither a scene nor a camera's file", "file = \"camera.toml\"", ""},
                        inner.at("file"));
    camera.calibrations.push_back(calibration);
  });
  check_periods(table, camera);
  if (camera.calibrations.empty()) {
    if (camera.scene.empty())
      throw scene_error(
          {"camera '" + camera.name + "' has no calibration and no scene",
           "[[camera.calibration]] with file = \"camera.toml\"", "vegard calibrate writes such files"},
          table.at("calibration"));
    camera.calibrations.emplace_back();
  }
  return camera;
}

SurveySkip read_skip(SurveyTable& table, const Survey& survey) {
  SurveySkip skip;
  skip.camera = table.text("camera");
  const auto is_it = [&](const SurveyCamera& camera) { return camera.name == skip.camera; };
  if (!skip.camera.empty() && std::none_of(survey.cameras.begin(), survey.cameras.end(), is_it)) {
    std::vector<std::string> names;
    for (const SurveyCamera& camera : survey.cameras) names.push_back(camera.name);
    throw scene_error({"there is no camera '" + skip.camera + "'", "the name of a [[camera]]",
                       sim::nearest_hint(skip.camera, names)},
                      table.at("camera"));
  }
  skip.period = period_of(table);
  skip.list = table.text("list");
  skip.reason = table.text("reason");
  if (skip.reason.empty())
    throw scene_error({"it is not said why", "reason = \"fog\"", ""}, table.at("reason"));
  if (skip.camera.empty() && skip.list.empty() && std::isinf(skip.period.from_s) &&
      std::isinf(skip.period.until_s))
    throw scene_error({"this skips everything", "camera, from, until or list", ""}, table.at("reason"));
  return skip;
}

Survey survey_of(const toml::table& document, const std::string& file) {
  Survey survey;
  survey.file = file;
  SurveyTable root(document, file, "", 1);
  std::string scene;
  bool has_head = false;
  root.table("survey", [&](SurveyTable& table) {
    has_head = true;
    read_head(table, survey, scene);
  });
  if (!has_head)
    throw scene_error({"there is no table [survey]", "[survey] with name and work", ""}, {file, 1, "survey"});
  std::set<std::string> names;
  root.each("camera", [&](SurveyTable& table) {
    survey.cameras.push_back(read_camera(table, scene));
    if (!names.insert(survey.cameras.back().name).second)
      throw scene_error(
          {"two cameras are called '" + survey.cameras.back().name + "'", "a name of its own for each", ""},
          table.at("name"));
  });
  if (survey.cameras.empty())
    throw scene_error({"there is no camera", "[[camera]]", ""}, {file, 1, "camera"});
  root.each("skip", [&](SurveyTable& table) { survey.skips.push_back(read_skip(table, survey)); });
  root.refuse_unknown();
  return survey;
}

}  // namespace

Survey parse_survey(const std::string& text, const std::string& file) {
  Survey survey = survey_of(sim::checked_toml(text, file), file);
  survey.sha256 = sim::sha256(text);
  return survey;
}

Survey read_survey(const std::string& file) {
  return parse_survey(sim::input_bytes(file, "a survey (TOML)", sim::kMaxTomlBytes), file);
}

}  // namespace vegard::fit
