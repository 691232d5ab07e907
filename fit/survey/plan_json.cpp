#include "fit/survey/plan_json.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"

namespace vegard::fit {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPlanKind = "vegard survey plan";
constexpr int kPlanFormat = 1;
/// A winter of ten cameras, 7 million frames, has 600 MB.
constexpr std::size_t kMaxPlanBytes = (std::size_t{1} << 31) - 1;

std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// Limits of a period; null where it has none.
Json limit_json(double seconds) { return std::isfinite(seconds) ? Json(seconds) : Json(nullptr); }

Json camera_json_of_plan(const SurveyCamera& camera) {
  Json json = {{"name", camera.name},         {"scene", camera.scene},     {"set", camera.changes},
               {"decoding", camera.decoding}, {"channel", camera.channel}, {"calibrations", Json::array()}};
  if (!camera.filter.empty()) json["filter"] = camera.filter;
  for (const SurveyCalibration& c : camera.calibrations)
    json["calibrations"].push_back({{"from_s", limit_json(c.period.from_s)},
                                    {"until_s", limit_json(c.period.until_s)},
                                    {"file", c.file},
                                    {"mask", c.mask}});
  return json;
}

Json frame_json(const PlannedFrame& frame) {
  Json json = Json::array({frame.file, frame.time_s});
  if (!frame.skip.empty()) json.push_back(frame.skip);
  return json;
}

/// What is no plan, reported at once.
[[noreturn]] void refuse_plan(const std::string& file, const std::string& problem) {
  throw sim::Error(sim::ErrorKind::unreadable_input,
                   {problem, file, 0, {}, "what vegard survey plan wrote", {}});
}

double finite_number(const Json& json) {
  const double value = json.get<double>();
  if (!std::isfinite(value)) throw std::out_of_range("no finite number");
  return value;
}

/// JSON's numbers may be of any size, and reals.
int whole_number(const Json& json) {
  const auto value =
      json.is_number_integer() ? json.get<std::int64_t>() : std::numeric_limits<std::int64_t>::min();
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    throw std::out_of_range("no whole number");
  return static_cast<int>(value);
}

SurveyCamera camera_of_json(const Json& json) {
  SurveyCamera camera;
  camera.name = json.at("name").get<std::string>();
  camera.scene = json.at("scene").get<std::string>();
  camera.changes = json.at("set").get<std::vector<std::string>>();
  camera.decoding = json.at("decoding").get<std::string>();
  camera.channel = whole_number(json.at("channel"));
  if (camera.channel < 0 || camera.channel > 2) throw std::out_of_range("no channel");
  if (json.contains("filter")) camera.filter = json.at("filter").get<std::string>();
  for (const Json& c : json.at("calibrations")) {
    SurveyCalibration calibration;
    if (!c.at("from_s").is_null()) calibration.period.from_s = finite_number(c.at("from_s"));
    if (!c.at("until_s").is_null()) calibration.period.until_s = finite_number(c.at("until_s"));
    calibration.file = c.at("file").get<std::string>();
    calibration.mask = c.at("mask").get<std::string>();
    camera.calibrations.push_back(calibration);
  }
  return camera;
}

PlannedBlock block_of_json(const Json& json, const SurveyPlan& plan, int first_frame) {
  PlannedBlock block;
  block.camera = whole_number(json.at("camera"));
  const SurveyCamera& camera = plan.cameras.at(static_cast<std::size_t>(block.camera));
  block.calibration = whole_number(json.at("calibration"));
  if (block.calibration < -1 || block.calibration >= static_cast<int>(camera.calibrations.size()))
    throw std::out_of_range("no calibration");
  block.first_frame = first_frame;
  block.seconds = finite_number(json.at("seconds"));
  if (block.seconds < 0.0) throw std::out_of_range("no duration");
  for (const Json& f : json.at("frames")) {
    PlannedFrame frame{f.at(0).get<std::string>(), finite_number(f.at(1)), {}};
    if (f.size() > 2) frame.skip = f.at(2).get<std::string>();
    if (block.calibration < 0 && frame.skip.empty()) throw std::out_of_range("no calibration");
    block.frames.push_back(std::move(frame));
  }
  if (block.frames.empty()) throw std::out_of_range("an empty block");
  return block;
}

}  // namespace

std::string plan_json(const SurveyPlan& plan) {
  Json head;
  head["kind"] = kPlanKind;
  head["format"] = kPlanFormat;
  head["version"] = plan.version;
  head["name"] = plan.name;
  head["folder"] = plan.folder;
  head["work"] = Json::array();
  for (const SurveyWork work : plan.work) head["work"].push_back(survey_work_name(work));
  head["cameras"] = Json::array();
  for (const SurveyCamera& camera : plan.cameras) head["cameras"].push_back(camera_json_of_plan(camera));
  head["inputs"] = Json::array();
  for (const PlanInput& input : plan.inputs)
    head["inputs"].push_back({{"what", input.what}, {"sha256", input.sha256}});
  head["shards"] = plan.shards;
  std::string text = "{\n";
  for (const auto& [key, value] : head.items()) text += dump(key) + ": " + dump(value) + ",\n";
  text += "\"blocks\": [";
  bool is_first = true;
  for (const PlannedBlock& block : plan.blocks) {
    Json json = {{"camera", block.camera},
                 {"calibration", block.calibration},
                 {"seconds", block.seconds},
                 {"frames", Json::array()}};
    for (const PlannedFrame& frame : block.frames) json["frames"].push_back(frame_json(frame));
    text += (is_first ? "\n" : ",\n") + dump(json);
    is_first = false;
  }
  return text + "\n]\n}\n";
}

SurveyPlan plan_of_json(const std::string& text, const std::string& file) {
  SurveyPlan plan;
  try {
    const Json json = Json::parse(text);
    if (!json.is_object() || !json.contains("kind") || json.at("kind") != kPlanKind)
      refuse_plan(file, "is no plan of a survey");
    if (json.at("format") != kPlanFormat)
      refuse_plan(file, "is a plan of another format, of another version of vegard");
    plan.version = json.at("version").get<std::string>();
    plan.name = json.at("name").get<std::string>();
    if (!is_plain_name(plan.name)) throw std::out_of_range("no name");
    plan.folder = json.at("folder").get<std::string>();
    for (const Json& name : json.at("work")) {
      const auto work = survey_work_of(name.get<std::string>());
      if (!work) throw std::out_of_range("no work");
      plan.work.push_back(*work);
    }
    for (const Json& camera : json.at("cameras")) plan.cameras.push_back(camera_of_json(camera));
    for (const Json& input : json.at("inputs"))
      plan.inputs.push_back({input.at("what").get<std::string>(), input.at("sha256").get<std::string>()});
    plan.shards = whole_number(json.at("shards"));
    if (plan.shards < 1) throw std::out_of_range("no shard");
    int frames = 0;
    for (const Json& block : json.at("blocks")) {
      plan.blocks.push_back(block_of_json(block, plan, frames));
      frames += static_cast<int>(plan.blocks.back().frames.size());
    }
    if (plan.blocks.empty()) throw std::out_of_range("no block");
  } catch (const nlohmann::json::exception&) {
    refuse_plan(file, "is no plan of a survey, or a damaged one");
  } catch (const std::out_of_range&) {
    refuse_plan(file, "is a damaged plan: it names what is not there");
  }
  plan.file = file;
  plan.sha256 = sim::sha256(text);
  return plan;
}

SurveyPlan read_plan(const std::string& file) {
  return plan_of_json(sim::input_bytes(file, "a plan of vegard survey plan", kMaxPlanBytes), file);
}

}  // namespace vegard::fit
