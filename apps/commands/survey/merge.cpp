#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "apps/commands/survey/shard_folder.h"
#include "apps/commands/survey/steps.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "fit/survey/survey_merge.h"

namespace vegard::apps {
namespace {

struct MergeRequest {
  std::vector<std::string> inputs;
  std::string out;
  bool mixed = false, overwrite = false;
};

/// Folders as the shards in them.
std::vector<std::string> databases_of(const MergeRequest& options) {
  std::vector<std::string> found;
  for (const std::string& input : options.inputs) {
    std::error_code error;
    if (!std::filesystem::is_directory(input, error)) {
      found.push_back(input);
      continue;
    }
    const std::vector<ShardFile> shards = shard_files(input);
    if (shards.empty())
      throw usage_error("DATABASE", "there is no shard in the folder '" + input + "'",
                        "the folder of vegard survey run, or databases");
    for (const ShardFile& shard : shards) found.push_back(shard.path);
  }
  return found;
}

int run_merge(const MergeRequest& options) {
  const std::vector<std::string> databases = databases_of(options);
  for (const std::string& database : databases)
    protect_inputs("--output", options.out, {{database, "a database to merge"}});
  const fit::SurveyMerge merge = fit::merge_surveys(databases, options.out, options.mixed, options.overwrite);
  json_answer() = {{"outputs", json_names({options.out})}, {"frames", merge.frames},
                   {"databases", merge.databases},         {"plans", merge.plans},
                   {"versions", merge.versions},           {"lacking", merge.lacking}};
  say("%d frame%s of %d database%s\n", merge.frames, merge.frames == 1 ? "" : "s", merge.databases,
      merge.databases == 1 ? "" : "s");
  if (merge.plans > 1 || merge.versions > 1)
    say("of %d plan%s and %d version%s\n", merge.plans, merge.plans == 1 ? "" : "s", merge.versions,
        merge.versions == 1 ? "" : "s");
  if (merge.lacking == 0) return good;
  say("%d frame%s of the plan %s not there yet\n", merge.lacking, merge.lacking == 1 ? "" : "s",
      merge.lacking == 1 ? "is" : "are");
  return doubted;
}

}  // namespace

void add_survey_merge(const Command& survey) {
  const auto options = std::make_shared<MergeRequest>();
  const Command command = survey.add("merge", "Merge the databases of all shards");
  command.option("DATABASE", options->inputs, "Databases, or the folder of vegard survey run").required();
  command.option("-o,--output", options->out, "The database to write").required().type_name("OUT.sqlite");
  command.flag("--mixed", options->mixed, "Also merge databases of different plans or versions of vegard");
  command.flag("--overwrite", options->overwrite, "Replace a file that exists");
  command.runs([options] { return run_merge(*options); });
}

}  // namespace vegard::apps
