#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/survey/shard_folder.h"
#include "apps/commands/survey/slurm_job.h"
#include "apps/commands/survey/steps.h"
#include "apps/options/exit_code.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "fit/survey/survey_results.h"

namespace vegard::apps {
namespace {

int run_status(const std::string& folder) {
  const std::vector<ShardFile> shards = shard_files(folder);
  const std::string job = job_of_folder(folder);
  if (shards.empty() && job.empty())
    throw usage_error("DIR", "there is no shard in '" + folder + "'",
                      "the folder of vegard survey run or submit");
  std::vector<int> counts(fit::kFrameStatuses.size(), 0);
  int frames = 0, planned = 0;
  std::string name;
  for (const ShardFile& shard : shards) {
    const fit::SqliteFile file(shard.path, fit::SqliteFile::Opening::read);
    const std::vector<int> of_shard = fit::count_by_status(file);
    for (std::size_t s = 0; s < counts.size(); ++s) {
      counts[s] += of_shard[s];
      frames += of_shard[s];
    }
    const fit::SurveyReader reader(file);
    planned = reader.plans().front().frames;
    name = reader.plans().front().name;
  }
  if (!shards.empty())
    say_result(fmt::format(
        "{}: {} of {} frames: {} done, {} skipped, {} missing, {} unreadable{}; {} of {} shards begun\n",
        name, frames, planned, counts[0], counts[1], counts[2], counts[3],
        counts[4] > 0 ? fmt::format(", {} filtered", counts[4]) : "", shards.size(), shards.front().shards));
  json_answer() = {{"name", name},
                   {"frames", frames},
                   {"planned", planned},
                   {"done", counts[0]},
                   {"skipped", counts[1]},
                   {"missing", counts[2]},
                   {"unreadable", counts[3]},
                   {"filtered", counts[4]},
                   {"shards_begun", shards.size()},
                   {"shards", shards.empty() ? 0 : shards.front().shards}};
  if (!job.empty()) {
    const std::string state = state_of_job(job);
    say_result("job " + job + ": " + (state.empty() ? "no longer in the queue" : state) + "\n");
    json_answer()["job"] = job;
    json_answer()["job_state"] = state.empty() ? Json(nullptr) : Json(state);
  }
  return frames == planned && planned > 0 ? good : doubted;
}

}  // namespace

void add_survey_status(const Command& survey) {
  const auto folder = std::make_shared<std::string>();
  const Command command = survey.add("status", "Show the progress of a survey");
  command.option("DIR", *folder, "The folder of its shards").required();
  command.runs([folder] { return run_status(*folder); });
}

}  // namespace vegard::apps
