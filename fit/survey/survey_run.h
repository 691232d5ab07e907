// Does a shard's work: analyses blocks of frames one after the other and stores the answers.
#pragma once

#include <functional>
#include <string>

#include "fit/search/fit_options.h"
#include "fit/survey/survey_frame.h"
#include "fit/survey/survey_plan.h"
#include "fit/survey/survey_results.h"

namespace vegard::fit {

struct SurveyRunOptions {
  int threads = 1;                          ///< the answers do not depend on it
  const std::atomic<bool>* stop = nullptr;  ///< set by Ctrl-C: the current frame is abandoned
  EyeOfPlan eye;                            ///< called when a block needs it
  /// Called after every frame, and once before the first with the number of frames done in earlier runs.
  std::function<void(int frames_done, int frames_of_shard)> progress;
};

/// Analyses the frames of these blocks that are not in `results`. Returns false if it was stopped. Answers
/// are stored about once per second of work, or after each frame if that takes longer, and at the end of a
/// block. Throws as ShardResults::add() and options.eye do.
bool run_shard(const SurveyPlan& plan, const BlockRange& blocks, ShardResults& results,
               const SurveyRunOptions& options);

/// Removes from each of these blocks the answers from the first frame on that was missing and now exists, or
/// that was unreadable and whose file has changed. run_shard() then analyses this frame and all later ones of
/// its block, as if the file had been there from the beginning. Returns the number of frames removed. Throws
/// as ShardResults does.
int discard_outdated_results(const SurveyPlan& plan, const BlockRange& blocks, ShardResults& results);

/// Returns "shard-0003-of-0120.sqlite".
std::string shard_name(int shard, int shards);

}  // namespace vegard::fit
