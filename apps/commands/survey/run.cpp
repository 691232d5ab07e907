#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/survey/local_processes.h"
#include "apps/commands/survey/shard_folder.h"
#include "apps/commands/survey/steps.h"
#include "apps/options/exit_code.h"
#include "apps/options/json_answer.h"
#include "apps/options/memory_limit.h"
#include "apps/options/standard_streams.h"
#include "apps/options/survey_eyes.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "fit/survey/survey_plan.h"
#include "fit/survey/survey_run.h"
#include "sim/base/file/number_text.h"

namespace vegard::apps {
namespace {

struct RunRequest {
  std::string plan, out, shard, memory_limit;
  std::optional<int> local;
  int threads = 1;
  bool again = false;
};

/// What a shard reports while it works: a line a minute, on standard error as all that depends on the clock,
/// and one at the end.
class ShardAccount {
 public:
  explicit ShardAccount(const std::string& name) : name_(name), bar_(name) {}

  void tell_progress(int done, int all) {
    if (first_ < 0) first_ = done;
    done_ = done;
    all_ = all;
    bar_.update(all > 0 ? static_cast<double>(done) / all : 1.0);
    constexpr double kBetween_s = 60.0;
    if (bar_.elapsed_seconds() < last_s_ + kBetween_s) return;
    last_s_ = bar_.elapsed_seconds();
    tell_pace();
  }
  void tell_end() {
    bar_.finish();
    constexpr double kWorthAWord_s = 10.0;
    if (bar_.elapsed_seconds() > kWorthAWord_s) tell_pace();
    json_answer() = {{"shard", name_}, {"frames_done", done_}, {"frames", all_}};
    say("%s: %d of %d frames\n", name_.c_str(), done_, all_);
    show_output();
  }

 private:
  void tell_pace() const {
    if (done_ == first_) return;
    const double seconds = bar_.elapsed_seconds() / (done_ - first_);
    apps::tell_progress("%s: %d of %d frames, %s s a frame\n", name_.c_str(), done_, all_,
                        sim::short_number(seconds, 3).c_str());
  }

  std::string name_;
  ProgressBar bar_;
  int first_ = -1, done_ = 0, all_ = 0;
  double last_s_ = 0.0;
};

int run_one(const RunRequest& options, const fit::SurveyPlan& plan, int shard, int shards) {
  ShardAccount account(fmt::format("shard {}/{}", shard, shards));
  fit::SurveyRunOptions run;
  run.threads = options.threads;
  run.stop = &watch_for_interrupt();
  const bool fits = std::count(plan.work.begin(), plan.work.end(), fit::SurveyWork::fit) > 0;
  run.eye = [&](int camera, int calibration) {
    fit::SurveyEye eye = planned_eye(plan, camera, calibration);
    if (fits) check_memory_of_fit(eye.scene, options.threads, options.memory_limit);
    return eye;
  };
  run.progress = [&](int done, int all) { account.tell_progress(done, all); };
  const fit::BlockRange blocks = fit::blocks_of_shard(plan, shard, shards);
  // Before the database is made: a survey that is not what was planned leaves nothing.
  for (int b = blocks.begin; b < blocks.end; ++b) {
    const fit::PlannedBlock& block = plan.blocks[static_cast<std::size_t>(b)];
    if (block.calibration < 0) continue;
    run.eye(block.camera, block.calibration);
    break;
  }
  begin_shard_folder(options.out, shards);
  fit::ShardResults results(options.out + "/" + fit::shard_name(shard, shards), plan);
  if (options.again)
    if (const int forgotten = fit::discard_outdated_results(plan, blocks, results); forgotten > 0)
      say("shard %d/%d: %d frames again\n", shard, shards, forgotten);
  const bool finished = fit::run_shard(plan, blocks, results, run);
  account.tell_end();
  if (results.frames_of_others() > 0)
    tell("vegard: another process works on this shard as well: %d of these frames were there already\n",
         results.frames_of_others());
  if (finished) return good;
  tell("interrupted; the same command goes on from here\n");
  return interrupted;
}

int run_local(const RunRequest& options, const fit::SurveyPlan& plan) {
  // As it was begun; else enough for the last to end about when the others do.
  constexpr int kShardsEach = 4;
  const std::vector<ShardFile> found = shard_files(options.out);
  const int shards = !found.empty() ? found.front().shards
                                    : std::max(plan.shards, std::min(kShardsEach * *options.local,
                                                                     static_cast<int>(plan.blocks.size())));
  check_planned_eyes(plan);
  begin_shard_folder(options.out, shards);
  std::vector<LocalCall> calls;
  for (int shard = 1; shard <= shards; ++shard) {
    const std::string words = fmt::format("{}/{}", shard, shards);
    calls.push_back({"shard " + words,
                     {"survey", "run", options.plan, "--out", options.out, "--shard", words, "--threads",
                      std::to_string(options.threads)}});
    if (options.again) calls.back().words.emplace_back("--again");
    // The shards' words would stand before the answer.
    if (voice().is_quiet || voice().is_json) calls.back().words.emplace_back("--quiet");
    if (!options.memory_limit.empty())
      calls.back().words.insert(calls.back().words.end(), {"--memory-limit", options.memory_limit});
  }
  const ExitCode end = run_processes(calls, *options.local);
  json_answer() = {{"folder", options.out}, {"shards", shards}, {"processes", *options.local}};
  if (end == interrupted) tell("interrupted; the same command goes on from here\n");
  return end;
}

int run_survey(const RunRequest& options) {
  const fit::SurveyPlan plan = fit::read_plan(options.plan);
  if (options.local) return run_local(options, plan);
  const auto [shard, shards] = options.shard.empty() ? std::pair(1, 1) : shard_words(options.shard);
  return run_one(options, plan, shard, shards);
}

}  // namespace

void add_survey_run(const Command& survey) {
  const auto options = std::make_shared<RunRequest>();
  const Command command =
      survey.add("run", "Measure the frames of a plan, or of one shard of it; continues an earlier run");
  command.option("PLAN", options->plan, "The plan, of vegard survey plan").required();
  command.option("--out", options->out, "The folder of the results, a database for each shard")
      .required()
      .type_name("DIR");
  const Option shard =
      command.option("--shard", options->shard, "Only this shard, such as 3/120 (default: 1/1)")
          .type_name("I/N");
  command.option("--local", options->local, "Measure all shards by this number of processes on this machine")
      .type_name("J")
      .range(1, 1024)
      .excludes(shard);
  command.flag("--again", options->again,
               "Measure frames that were missing or unreadable and have been replaced, with those after them "
               "in their block");
  add_memory_option(command, options->memory_limit);
  command
      .option("--threads", options->threads, "Threads of each process (0: all cores); the result is the same")
      .range(0, 1024)
      .shows_default();
  command.runs([options] { return run_survey(*options); });
}

}  // namespace vegard::apps
