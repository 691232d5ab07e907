#include "fit/survey/survey_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

constexpr double kSecondsPerMinute = 60.0;

/// Returns the index of the camera's calibration at a time; -1 if there is none.
int calibration_at(const SurveyCamera& camera, double time_s) {
  for (std::size_t i = 0; i < camera.calibrations.size(); ++i)
    if (camera.calibrations[i].period.has(time_s)) return static_cast<int>(i);
  return -1;
}

using Json = nlohmann::ordered_json;

constexpr const char* kPlanKind = "vegard survey plan";
constexpr int kPlanFormat = 1;
/// A winter of ten cameras, 7 million frames, has 600 MB.
constexpr std::size_t kMaxPlanBytes = (std::size_t{1} << 31) - 1;

std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// Returns a limit of a period as JSON; null where it has none.
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

sim::Error bad_plan(const std::string& file, const std::string& problem) {
  return sim::unreadable(file, problem).expected("what vegard survey plan wrote");
}

double finite_number(const Json& json) {
  const double value = json.get<double>();
  if (!std::isfinite(value)) throw std::out_of_range("no finite number");
  return value;
}

/// Reads an int: JSON's numbers may be of any size, and reals.
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

int SurveyPlan::frames() const { return blocks.empty() ? 0 : blocks.back().end_frame(); }

double SurveyPlan::seconds() const {
  double sum = 0.0;
  for (const PlannedBlock& block : blocks) sum += block.seconds;
  return sum;
}

std::string SurveyPlan::place(const std::string& name) const {
  const std::filesystem::path beside = std::filesystem::path(file).parent_path() / folder;
  return (beside / name).lexically_normal().string();
}

std::string SurveyPlan::sha256_of(const std::string& what) const {
  for (const PlanInput& input : inputs)
    if (input.what == what) return input.sha256;
  return {};
}

std::string setup_words(const SurveyCamera& camera, int calibration) {
  return "the setup of " + camera.name + ", calibration " + std::to_string(calibration + 1);
}

SurveyPlan plan_survey(const Survey& survey, const std::vector<PlanInput>& setups) {
  SurveyPlan plan;
  plan.name = survey.name;
  plan.version = sim::version();
  plan.work = survey.work;
  plan.cameras = survey.cameras;
  plan.inputs = {{"the survey", survey.sha256}};
  plan.inputs.insert(plan.inputs.end(), setups.begin(), setups.end());
  double cost_s = 0.0;
  for (const SurveyWork work : survey.work) cost_s += survey.cost_s[static_cast<std::size_t>(work)];
  int number = 0, worked = 0;
  for (std::size_t c = 0; c < survey.cameras.size(); ++c) {
    ListedFrames listed = survey_frames(survey, survey.cameras[c]);
    plan.inputs.insert(plan.inputs.end(), listed.sources.begin(), listed.sources.end());
    double last_s = 0.0;
    bool is_new = true;
    for (PlannedFrame& frame : listed.frames) {
      const int calibration = calibration_at(survey.cameras[c], frame.time_s);
      if (is_new || calibration != plan.blocks.back().calibration || frame.time_s - last_s > survey.gap_s ||
          static_cast<int>(plan.blocks.back().frames.size()) >= survey.block_frames) {
        plan.blocks.emplace_back();
        plan.blocks.back().camera = static_cast<int>(c);
        plan.blocks.back().calibration = calibration;
        plan.blocks.back().first_frame = number;
        worked = 0;
      }
      is_new = false;
      last_s = frame.time_s;
      PlannedBlock& block = plan.blocks.back();
      if (frame.skip.empty() && calibration < 0) frame.skip = "the camera has no calibration for this time";
      if (frame.skip.empty()) worked += 1;
      block.seconds = worked * cost_s;
      block.frames.push_back(std::move(frame));
      ++number;
    }
  }
  plan.shards = shard_count(plan.blocks, survey.shard_minutes * kSecondsPerMinute, survey.max_shards);
  for (SurveyCamera& camera : plan.cameras) {
    camera.frames.clear();
    camera.endings.clear();
    camera.line = 0;
  }
  return plan;
}

int shard_count(const std::vector<PlannedBlock>& blocks, double min_seconds, int max_shards) {
  double sum = 0.0, longest = 0.0;
  for (const PlannedBlock& block : blocks) {
    sum += block.seconds;
    longest = std::max(longest, block.seconds);
  }
  // Cut where the whole is cut into equal parts, a shard is shorter than its part by a block at most.
  const double part = min_seconds + longest;
  const double count = part > 0.0 ? std::floor(sum / part) : static_cast<double>(blocks.size());
  const double most = std::min<double>(max_shards, static_cast<double>(blocks.size()));
  return std::max(1, static_cast<int>(std::min(count, most)));
}

BlockRange blocks_of_shard(const SurveyPlan& plan, int shard, int shards) {
  // A block belongs to the part of the whole in which its middle lies. Blocks that cost nothing count a
  // little, so that a plan of skipped frames is cut as well.
  constexpr double kMin_s = 1e-3;
  double sum = 0.0;
  for (const PlannedBlock& block : plan.blocks) sum += block.seconds + kMin_s;
  BlockRange range{static_cast<int>(plan.blocks.size()), static_cast<int>(plan.blocks.size())};
  double before = 0.0;
  for (std::size_t b = 0; b < plan.blocks.size(); ++b) {
    const double seconds = plan.blocks[b].seconds + kMin_s;
    const int of_block =
        std::min(shards, 1 + static_cast<int>(std::floor((before + 0.5 * seconds) / sum * shards)));
    before += seconds;
    if (of_block >= shard) range.begin = std::min(range.begin, static_cast<int>(b));
    if (of_block > shard) {
      range.end = static_cast<int>(b);
      break;
    }
  }
  return range;
}

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
      throw bad_plan(file, "is no plan of a survey");
    if (json.at("format") != kPlanFormat)
      throw bad_plan(file, "is a plan of another format, of another version of vegard");
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
    throw bad_plan(file, "is no plan of a survey, or a damaged one");
  } catch (const std::out_of_range&) {
    throw bad_plan(file, "is a damaged plan: it names what is not there");
  }
  plan.file = file;
  plan.sha256 = sim::sha256(text);
  return plan;
}

SurveyPlan read_plan(const std::string& file) {
  return plan_of_json(sim::input_bytes(file, "a plan of vegard survey plan", kMaxPlanBytes), file);
}

}  // namespace vegard::fit
