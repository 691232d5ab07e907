#include "fit/survey/survey_run.h"

#include <atomic>
#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fit/photo/frames/frame_name.h"
#include "fit/survey/survey_frame.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"

namespace vegard::fit {
namespace {

/// Frames that are finished and not yet kept.
class FramesToKeep {
 public:
  explicit FramesToKeep(ShardResults& results) : results_(results) {}

  /// Adds an answer. Returns true if it is kept now, with those before it.
  bool add(FrameAnswer answer) {
    constexpr auto kLongest = std::chrono::seconds(1);
    frames_.push_back(std::move(answer));
    if (Clock::now() - last_ < kLongest) return false;
    keep();
    return true;
  }
  void keep() {
    if (!frames_.empty()) results_.add(frames_);
    frames_.clear();
    last_ = Clock::now();
  }

 private:
  using Clock = std::chrono::steady_clock;
  ShardResults& results_;
  std::vector<FrameAnswer> frames_;
  Clock::time_point last_ = Clock::now();
};

bool run_block(const SurveyPlan& plan, int number, const SurveyEye* eye, SurveyPictures& pictures,
               ShardResults& results, const SurveyRunOptions& options,
               const std::function<void()>& done_one) {
  FitOptions fit_options;
  fit_options.threads = options.threads;
  fit_options.stop = options.stop;
  const PlannedBlock& block = plan.blocks[static_cast<std::size_t>(number)];
  std::optional<WorkAnswer> before = results.last_fit(number);
  FramesToKeep frames(results);
  for (int f = results.done(number); f < static_cast<int>(block.frames.size()); ++f) {
    std::optional<FrameAnswer> answer =
        survey_frame({&plan, number, f, before ? &*before : nullptr}, eye, fit_options, pictures);
    if (!answer || (options.stop != nullptr && options.stop->load())) {
      frames.keep();
      return false;
    }
    for (const WorkAnswer& work : answer->works)
      if (work.work == SurveyWork::fit && work.verdict != "refused") before = work;
    const bool is_kept = frames.add(std::move(*answer));
    done_one();
    // Where another process is ahead, its answers are gone on with.
    if (is_kept && results.done(number) > f + 1) {
      before = results.last_fit(number);
      for (; results.done(number) > f + 1; ++f) done_one();
    }
  }
  frames.keep();
  return true;
}

}  // namespace

bool run_shard(const SurveyPlan& plan, const BlockRange& blocks, ShardResults& results,
               const SurveyRunOptions& options) {
  int done = 0, all = 0;
  for (int b = blocks.begin; b < blocks.end; ++b) {
    done += results.done(b);
    all += static_cast<int>(plan.blocks[static_cast<std::size_t>(b)].frames.size());
  }
  options.progress(done, all);
  LatestEye eyes(options.eye);
  SurveyPictures pictures;
  for (int b = blocks.begin; b < blocks.end; ++b) {
    const PlannedBlock& block = plan.blocks[static_cast<std::size_t>(b)];
    if (results.done(b) == static_cast<int>(block.frames.size())) continue;
    const SurveyEye* eye = block.calibration < 0 ? nullptr : &eyes.of(block.camera, block.calibration);
    if (!run_block(plan, b, eye, pictures, results, options, [&] { options.progress(++done, all); }))
      return false;
  }
  return true;
}

int discard_outdated_results(const SurveyPlan& plan, const BlockRange& blocks, ShardResults& results) {
  int forgotten = 0;
  for (int b = blocks.begin; b < blocks.end; ++b) {
    const PlannedBlock& block = plan.blocks[static_cast<std::size_t>(b)];
    for (const ShardResults::Lost& lost : results.lost(b)) {
      const auto number = static_cast<std::size_t>(lost.frame - block.first_frame);
      const std::string file = file_of_frame(plan.place(block.frames.at(number).file));
      if (!sim::why_no_input(file).empty()) continue;
      if (lost.status == FrameStatus::unreadable && sim::sha256_of_file(file) == lost.sha256) continue;
      forgotten += results.forget(b, lost.frame);
      break;
    }
  }
  return forgotten;
}

std::string shard_name(int shard, int shards) {
  return fmt::format("shard-{:04}-of-{:04}.sqlite", shard, shards);
}

}  // namespace vegard::fit
