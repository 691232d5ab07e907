// Doing a shard's work: blocks of frames, one after the other, kept as they are finished.
#pragma once

#include <functional>
#include <string>

#include "fit/search/fit_options.h"
#include "fit/survey/survey_eye.h"
#include "fit/survey/survey_plan.h"
#include "fit/survey/survey_results.h"

namespace vegard::fit {

struct SurveyRunOptions {
  int threads = 1;                          ///< the answers do not depend on it
  const std::atomic<bool>* stop = nullptr;  ///< set by Ctrl-C: the frame at hand is given up
  /// The eye of a camera during one of its calibrations; asked for as blocks come.
  std::function<SurveyEye(int camera, int calibration)> eye;
  /// Called after every frame, and once before the first with what an earlier call has done.
  std::function<void(int frames_done, int frames_of_shard)> progress;
};

/// Does what is not yet done of these blocks. False if it was stopped. Frames are kept in transactions of
/// about a second, or of one frame where that takes longer, and at the end of a block. Throws as
/// ShardResults::add() and options.eye do.
bool run_shard(const SurveyPlan& plan, const BlockRange& blocks, ShardResults& results,
               const SurveyRunOptions& options);

/// Forgets what was done of these blocks from the first frame on that was missing and is there now, or that
/// could not be read and is another file: run_shard() then does it as if it had been there from the
/// beginning, with all that follows it in its block. How many frames are to be done again. Throws as
/// ShardResults does.
int discard_outdated_results(const SurveyPlan& plan, const BlockRange& blocks, ShardResults& results);

/// "shard-0003-of-0120.sqlite".
std::string shard_name(int shard, int shards);

}  // namespace vegard::fit
