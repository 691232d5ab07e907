#include "fit/survey/survey_plan.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "fit/survey/survey_frames.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

constexpr double kSecondsPerMinute = 60.0;

/// -1 where there is none for that time.
int calibration_at(const SurveyCamera& camera, double time_s) {
  for (std::size_t i = 0; i < camera.calibrations.size(); ++i)
    if (camera.calibrations[i].period.has(time_s)) return static_cast<int>(i);
  return -1;
}

}  // namespace

int SurveyPlan::frames() const {
  return blocks.empty() ? 0 : blocks.back().first_frame + static_cast<int>(blocks.back().frames.size());
}

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
    for (const FrameSource& source : listed.sources) plan.inputs.push_back({source.name, source.sha256});
    double last_s = 0.0;
    bool is_new = true;
    for (ListedFrame& frame : listed.frames) {
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
      block.frames.push_back({std::move(frame.file), frame.time_s, std::move(frame.skip)});
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

}  // namespace vegard::fit
