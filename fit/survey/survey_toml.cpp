#include "fit/survey/survey_toml.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"
#include "sim/base/utc_time.h"
#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/decoding_word.h"
#include "sim/scene/rows/nearest_name.h"
#include "sim/scene/table/bounded_toml.h"
#include "sim/scene/table/toml_value.h"

namespace vegard::fit {
namespace {

using sim::complain;
using sim::Origin;

constexpr double kMostSeconds = 1e6;

/// A table of the file whose keys are asked for one after the other; what nobody has asked for is unknown.
class SurveyTable {
 public:
  SurveyTable(const toml::table& table, std::string file, std::string path, int line)
      : table_(table), file_(std::move(file)), path_(std::move(path)), line_(line) {}

  int line() const { return line_; }
  const std::string& file() const { return file_; }

  const toml::node* get(const std::string& key) {
    known_.push_back(key);
    return table_.get(key);
  }

  Origin at(const std::string& key) const {
    const toml::node* node = table_.get(key);
    return {file_, node != nullptr ? sim::line_of(*node) : line_, path_.empty() ? key : path_ + "." + key};
  }

  std::string text(const std::string& key, const std::string& expected = "a text in quotes") {
    const toml::node* node = get(key);
    if (node == nullptr) return {};
    std::string found = sim::text_of(*node, at(key), expected);
    if (found.empty()) complain({"it is empty", expected, ""}, at(key));
    return found;
  }

  std::vector<std::string> texts(const std::string& key, const std::string& expected) {
    const toml::node* node = get(key);
    if (node == nullptr) return {};
    const toml::array* array = node->as_array();
    if (array == nullptr) complain({"found " + sim::found_text(*node), expected, ""}, at(key));
    std::vector<std::string> found;
    for (const toml::node& element : *array) {
      Origin origin = at(key);
      if (sim::line_of(element) > 0) origin.line = sim::line_of(element);
      found.push_back(sim::text_of(element, origin, expected));
      if (found.back().empty()) complain({"a text is empty", expected, ""}, origin);
    }
    return found;
  }

  void number(const std::string& key, double least, double most, double& value) {
    const toml::node* node = get(key);
    if (node == nullptr) return;
    const std::string expected = "a number from " + short_text(least) + " to " + short_text(most);
    const double found = sim::number_of(*node, at(key), expected);
    if (!(found >= least && found <= most))
      complain({sim::found_text(*node) + " is none", expected, ""}, at(key));
    value = found;
  }

  void whole_number(const std::string& key, int least, int most, int& value) {
    double found = value;
    number(key, least, most, found);
    if (found != std::floor(found)) complain({"it is no whole number", "a whole number", ""}, at(key));
    value = static_cast<int>(found);
  }

  void time(const std::string& key, double& seconds) {
    const std::string expected = "a time in UTC, \"2019-03-01T22:10:00Z\", or a day";
    const std::string found = text(key, expected);
    if (found.empty()) return;
    std::optional<double> read = sim::utc_seconds(found);
    if (!read && sim::has_form(found, "0000-00-00")) read = sim::utc_seconds(found + "T00:00:00Z");
    if (!read) complain({"'" + found + "' is no time", expected, ""}, at(key));
    seconds = *read;
  }

  SurveyPeriod period() {
    SurveyPeriod period;
    time("from", period.from_s);
    time("until", period.until_s);
    if (!(period.from_s < period.until_s))
      complain({"the period ends before it begins", "a time after 'from'", ""}, at("until"));
    return period;
  }

  /// The tables of an array of tables, [[name]].
  void each(const std::string& key, const std::function<void(SurveyTable& table)>& read) {
    const toml::node* node = get(key);
    if (node == nullptr) return;
    const toml::array* array = node->as_array();
    if (array == nullptr)
      complain({"found " + sim::found_text(*node), "tables, [[" + at(key).key + "]]", ""}, at(key));
    for (const toml::node& element : *array) {
      Origin origin = at(key);
      if (sim::line_of(element) > 0) origin.line = sim::line_of(element);
      const toml::table* table = element.as_table();
      if (table == nullptr)
        complain({"found " + sim::found_text(element), "tables, [[" + origin.key + "]]", ""}, origin);
      SurveyTable inner(*table, file_, origin.key, origin.line);
      read(inner);
      inner.refuse_unknown();
    }
  }

  /// A table of the file, [name]; not called where there is none.
  void table(const std::string& key, const std::function<void(SurveyTable& table)>& read) {
    const toml::node* node = get(key);
    if (node == nullptr) return;
    if (node->as_table() == nullptr)
      complain({"found " + sim::found_text(*node), "a table, [" + at(key).key + "]", ""}, at(key));
    SurveyTable inner(*node->as_table(), file_, at(key).key, sim::line_of(*node));
    read(inner);
    inner.refuse_unknown();
  }

  void refuse_unknown() const {
    for (const auto& [key, node] : table_) {
      const std::string name(key.str());
      if (std::find(known_.begin(), known_.end(), name) == known_.end())
        complain({"unknown key '" + name + "'", "", sim::nearest_hint(name, known_)}, at(name));
    }
  }

 private:
  static std::string short_text(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
  }

  const toml::table& table_;
  std::string file_, path_;
  int line_;
  std::vector<std::string> known_;
};

std::string plain_name(SurveyTable& table, const std::string& key) {
  const std::string expected = "letters, digits, _ and -, 64 at most";
  std::string name = table.text(key, expected);
  if (name.empty()) complain({"'" + key + "' is missing", expected, ""}, table.at(key));
  if (!is_plain_name(name)) complain({"'" + name + "' is no name", expected, ""}, table.at(key));
  return name;
}

void read_head(SurveyTable& table, Survey& survey, std::string& scene) {
  survey.name = plain_name(table, "name");
  const std::string works = "an array of \"filter\", \"border\", \"profile\", \"fit\" and \"map\"";
  for (const std::string& word : table.texts("work", works)) {
    const std::optional<SurveyWork> work = survey_work_of(word);
    if (!work) complain({"'" + word + "' is no work", works, ""}, table.at("work"));
    if (std::find(survey.work.begin(), survey.work.end(), *work) != survey.work.end())
      complain({"'" + word + "' stands there twice", works, ""}, table.at("work"));
    survey.work.push_back(*work);
  }
  if (survey.work.empty()) complain({"it is not said what to do with a frame", works, ""}, table.at("work"));
  std::sort(survey.work.begin(), survey.work.end());
  scene = table.text("scene");
  table.whole_number("block_frames", 1, 1000000, survey.block_frames);
  table.number("gap_s", 0.0, kMostSeconds, survey.gap_s);
  table.number("shard_minutes", 0.0, kMostSeconds, survey.shard_minutes);
  table.whole_number("most_shards", 1, 100000, survey.most_shards);
  survey.cost_s = kSurveyCost_s;
  table.table("cost_s", [&](SurveyTable& costs) {
    for (std::size_t w = 0; w < kSurveyWorks.size(); ++w)
      costs.number(survey_work_name(kSurveyWorks[w]), 0.0, kMostSeconds, survey.cost_s[w]);
  });
}

void check_periods(const SurveyTable& table, const SurveyCamera& camera) {
  for (std::size_t i = 0; i < camera.calibrations.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const SurveyPeriod &a = camera.calibrations[j].period, &b = camera.calibrations[i].period;
      if (a.from_s < b.until_s && b.from_s < a.until_s)
        complain({"calibrations " + std::to_string(j + 1) + " and " + std::to_string(i + 1) + " of '" +
                      camera.name + "' are for the same time",
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
    complain({"camera '" + camera.name + "' has no frames", frames, ""}, table.at("frames"));
  camera.endings = table.texts("endings", "an array of endings of file names, \".png\"");
  for (std::string& ending : camera.endings)
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (camera.endings.empty()) camera.endings = picture_endings();
  camera.decoding = table.text("decoding");
  if (const auto complaint = sim::decoding_complaint(camera.decoding); complaint && !camera.decoding.empty())
    complain(*complaint, table.at("decoding"));
  const std::string channel = table.text("channel");
  const std::vector<std::string> channels = {"red", "green", "blue"};
  if (!channel.empty()) {
    const auto found = std::find(channels.begin(), channels.end(), channel);
    if (found == channels.end())
      complain({"'" + channel + "' is no channel", "red, green or blue", ""}, table.at("channel"));
    camera.channel = static_cast<int>(found - channels.begin());
  }
  camera.filter = table.text("filter", "a file of scripts/learn_filter.py");
  table.each("calibration", [&](SurveyTable& inner) {
    SurveyCalibration calibration;
    calibration.period = inner.period();
    calibration.file = inner.text("file");
    calibration.mask = inner.text("mask");
    if (calibration.file.empty() && calibration.mask.empty())
      complain({"a calibration without 'file' and 'mask' says nothing", "file = \"camera.toml\"",
                "vegard calibrate writes such files"},
               inner.at("file"));
    if (calibration.file.empty() && camera.scene.empty())
      complain({"there is neither a scene nor a camera's file", "file = \"camera.toml\"", ""},
               inner.at("file"));
    camera.calibrations.push_back(calibration);
  });
  check_periods(table, camera);
  if (camera.calibrations.empty()) {
    if (camera.scene.empty())
      complain({"camera '" + camera.name + "' has no calibration and no scene",
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
    complain({"there is no camera '" + skip.camera + "'", "the name of a [[camera]]",
              sim::nearest_hint(skip.camera, names)},
             table.at("camera"));
  }
  skip.period = table.period();
  skip.list = table.text("list");
  skip.reason = table.text("reason");
  if (skip.reason.empty()) complain({"it is not said why", "reason = \"fog\"", ""}, table.at("reason"));
  if (skip.camera.empty() && skip.list.empty() && std::isinf(skip.period.from_s) &&
      std::isinf(skip.period.until_s))
    complain({"this skips everything", "camera, from, until or list", ""}, table.at("reason"));
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
    complain({"there is no table [survey]", "[survey] with name and work", ""}, {file, 1, "survey"});
  std::set<std::string> names;
  root.each("camera", [&](SurveyTable& table) {
    survey.cameras.push_back(read_camera(table, scene));
    if (!names.insert(survey.cameras.back().name).second)
      complain(
          {"two cameras are called '" + survey.cameras.back().name + "'", "a name of its own for each", ""},
          table.at("name"));
  });
  if (survey.cameras.empty()) complain({"there is no camera", "[[camera]]", ""}, {file, 1, "camera"});
  root.each("skip", [&](SurveyTable& table) { survey.skips.push_back(read_skip(table, survey)); });
  root.refuse_unknown();
  return survey;
}

}  // namespace

Survey parse_survey(const std::string& text, const std::string& file) {
  try {
    Survey survey = survey_of(sim::parse_toml(text, file), file);
    survey.sha256 = sim::sha256(text);
    return survey;
  } catch (const toml::parse_error& error) {
    sim::ErrorDetails details;
    details.problem = std::string(error.description());
    details.file = file;
    details.line = static_cast<int>(error.source().begin.line);
    details.expected = "a TOML file";
    throw sim::Error(sim::ErrorKind::scene, details);
  }
}

Survey read_survey(const std::string& file) {
  return parse_survey(sim::input_bytes(file, "a survey (TOML)", sim::kMostTomlBytes), file);
}

}  // namespace vegard::fit
