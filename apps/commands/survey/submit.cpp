#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "apps/commands/survey/shard_folder.h"
#include "apps/commands/survey/slurm_job.h"
#include "apps/commands/survey/steps.h"
#include "apps/options/exit_code.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/options/survey_eyes.h"
#include "fit/survey/survey_plan.h"
#include "fit/survey/survey_run.h"
#include "sim/base/error.h"

namespace vegard::apps {
namespace {

namespace fs = std::filesystem;

struct SubmitRequest {
  std::string plan, out;
  std::optional<int> shards;
  int threads = 1, at_once = 0;
  std::vector<std::string> sbatch;
  bool dry_run = false;
};

std::string absolute_path(const std::string& path) {
  std::error_code ignored;
  return fs::absolute(path, ignored).lexically_normal().string();
}

/// The program itself, by which the tasks call it.
std::string own_path() {
  std::error_code error;
  const fs::path path = fs::read_symlink("/proc/self/exe", error);
  return error ? "vegard" : path.string();
}

/// Shards that lack frames.
std::vector<int> unfinished(const fit::SurveyPlan& plan, const std::string& folder, int shards) {
  std::vector<int> frames(static_cast<std::size_t>(shards), 0), found;
  for (const ShardFile& file : shard_files(folder))
    frames[static_cast<std::size_t>(file.shard) - 1] = frames_in(file.path);
  for (int shard = 1; shard <= shards; ++shard) {
    const fit::BlockRange blocks = fit::blocks_of_shard(plan, shard, shards);
    int all = 0;
    for (int b = blocks.begin; b < blocks.end; ++b)
      all += static_cast<int>(plan.blocks[static_cast<std::size_t>(b)].frames.size());
    if (frames[static_cast<std::size_t>(shard) - 1] < all) found.push_back(shard);
  }
  return found;
}

/// Twice as long as the longest shard is estimated to take, in minutes, and half an hour at least.
int time_limit(const fit::SurveyPlan& plan, int shards) {
  constexpr double kReserve = 2.0, kMin = 30.0, kSecondsPerMinute = 60.0;
  double longest = 0.0;
  for (int shard = 1; shard <= shards; ++shard) {
    const fit::BlockRange blocks = fit::blocks_of_shard(plan, shard, shards);
    double seconds = 0.0;
    for (int b = blocks.begin; b < blocks.end; ++b)
      seconds += plan.blocks[static_cast<std::size_t>(b)].seconds;
    longest = std::max(longest, seconds);
  }
  return static_cast<int>(std::ceil(std::max(kMin, kReserve * longest / kSecondsPerMinute)));
}

int run_submit(const SubmitRequest& options) {
  const fit::SurveyPlan plan = fit::read_plan(options.plan);
  const std::vector<ShardFile> there = shard_files(options.out);
  const int begun = there.empty() ? 0 : there.front().shards;
  if (options.shards && begun > 0 && *options.shards != begun)
    throw usage_error("--shards", "the folder's survey is cut into " + std::to_string(begun),
                      "the same number");
  SlurmScript script;
  script.shards = begun > 0 ? begun : options.shards.value_or(plan.shards);
  script.tasks = unfinished(plan, options.out, script.shards);
  if (script.tasks.empty()) {
    json_answer() = {{"shards", script.shards}, {"tasks", 0}, {"job", nullptr}};
    say("all %d shards are finished\n", script.shards);
    return good;
  }
  script.program = own_path();
  script.plan = absolute_path(options.plan);
  script.folder = absolute_path(options.out);
  script.name = plan.name;
  script.threads = options.threads;
  script.at_once = options.at_once;
  script.minutes = time_limit(plan, script.shards);
  script.more = options.sbatch;
  const std::string text = slurm_script(script);
  if (options.dry_run) {
    json_answer() = {
        {"shards", script.shards}, {"tasks", script.tasks.size()}, {"job", nullptr}, {"script", text}};
    say_result(text);
    return good;
  }
  check_planned_eyes(plan);
  const std::string job = job_of_folder(options.out);
  if (const std::string state = job.empty() ? "" : state_of_job(job); !state.empty())
    throw sim::Error(sim::ErrorKind::existing_output, "job " + job + " is still at it: " + state)
        .file(options.out)
        .hint("vegard survey cancel ends it");
  begin_shard_folder(options.out, script.shards);
  std::error_code error;
  fs::create_directories(options.out + "/log", error);
  if (error) throw sim::unwritable(options.out + "/log", error.value());
  say_text(text);
  const std::string number = submit_to_slurm(script.folder, text);
  json_answer() = {
      {"shards", script.shards}, {"tasks", script.tasks.size()}, {"job", number}, {"script", text}};
  say("job %s: %zu of %d shards\n", number.c_str(), script.tasks.size(), script.shards);
  return good;
}

int run_cancel(const std::string& folder) {
  const std::string job = job_of_folder(folder);
  if (job.empty())
    throw usage_error("DIR", "there is no job of '" + folder + "'", "the folder of vegard survey submit");
  cancel_job(job);
  json_answer() = {{"job", job}, {"cancelled", true}};
  say("job %s is cancelled; what it has finished stays\n", job.c_str());
  return good;
}

}  // namespace

void add_survey_submit(const Command& survey) {
  const auto options = std::make_shared<SubmitRequest>();
  const Command command =
      survey.add("submit", "Submit the unfinished shards to a Slurm cluster, as an array of tasks");
  command.option("PLAN", options->plan, "The plan, of vegard survey plan").required();
  command.option("--out", options->out, "The folder of the results, a database for each shard")
      .required()
      .type_name("DIR");
  command.option("--shards", options->shards, "Number of shards (default: the plan's)")
      .range(1, 100000)
      .type_name("N");
  command.option("--threads", options->threads, "Threads, and cores, of each task")
      .range(1, 1024)
      .shows_default();
  command
      .option("--at-once", options->at_once,
              "Largest number of tasks at a time (default: the cluster's limit)")
      .range(1, 100000)
      .type_name("K");
  command
      .option("--sbatch", options->sbatch, "Another option of sbatch: --sbatch=--partition=long (repeatable)")
      .type_name("OPTION")
      .one_an_occurrence();
  command.flag("--dry-run", options->dry_run, "Only show the script");
  command.runs([options] { return run_submit(*options); });
}

void add_survey_cancel(const Command& survey) {
  const auto folder = std::make_shared<std::string>();
  const Command command = survey.add("cancel", "Remove a survey's tasks from the cluster's queue");
  command.option("DIR", *folder, "The folder of vegard survey submit").required();
  command.runs([folder] { return run_cancel(*folder); });
}

}  // namespace vegard::apps
