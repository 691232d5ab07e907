#include "apps/commands/survey/steps.h"

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/standard_streams.h"
#include "apps/options/survey_eyes.h"
#include "apps/output/progress_bar.h"
#include "fit/survey/survey.h"
#include "fit/survey/survey_plan.h"
#include "sim/base/file/whole_file.h"

namespace vegard::apps {
namespace {

namespace fs = std::filesystem;

struct PlanRequest {
  std::string survey, out;
  bool overwrite = false;
};

/// From the plan's folder to the survey's: both may move together.
std::string way_to_survey(const std::string& plan, const std::string& survey) {
  const auto folder_of = [](const std::string& file) {
    std::error_code ignored;
    return fs::weakly_canonical(fs::absolute(file, ignored).parent_path(), ignored);
  };
  return folder_of(survey).lexically_relative(folder_of(plan)).generic_string();
}

int run_plan(const PlanRequest& options) {
  const fit::Survey survey = fit::read_survey(options.survey);
  protect_inputs("--output", options.out, {{options.survey, "the survey"}});
  const SurveyPlaces place{survey.place("")};
  std::vector<fit::PlanInput> setups;
  for (const fit::SurveyCamera& camera : survey.cameras)
    for (std::size_t c = 0; c < camera.calibrations.size(); ++c) {
      const fit::SurveyCalibration& one = camera.calibrations[c];
      for (const std::string& file : {camera.scene, camera.filter, one.file, one.mask})
        protect_inputs("--output", options.out, {{place(file), "a file of camera " + camera.name}});
      setups.push_back(survey_setup(camera, static_cast<int>(c), place, survey.work));
    }
  fit::SurveyPlan plan = fit::plan_survey(survey, setups);
  plan.folder = way_to_survey(options.out, options.survey);
  sim::write_whole(options.out, fit::plan_json(plan), options.overwrite);
  int skipped = 0;
  for (const fit::PlannedBlock& block : plan.blocks)
    for (const fit::PlannedFrame& frame : block.frames) skipped += frame.skip.empty() ? 0 : 1;
  json_answer() = {{"outputs", json_names({options.out})},
                   {"cameras", plan.cameras.size()},
                   {"frames", plan.frames()},
                   {"skipped", skipped},
                   {"blocks", plan.blocks.size()},
                   {"estimated_s", json_number(plan.seconds())},
                   {"shards", plan.shards}};
  const auto plural = [](std::size_t count) { return count == 1 ? "" : "s"; };
  say("%zu camera%s, %d frames (%d skipped) in %zu block%s; about %s on one core: %d shard%s\n",
      plan.cameras.size(), plural(plan.cameras.size()), plan.frames(), skipped, plan.blocks.size(),
      plural(plan.blocks.size()), duration_text(plan.seconds()).c_str(), plan.shards,
      plural(static_cast<std::size_t>(plan.shards)));
  return good;
}

}  // namespace

void add_survey_plan(const Command& survey) {
  const auto options = std::make_shared<PlanRequest>();
  const Command command = survey.add("plan", "List all frames, and cut the work into blocks and shards");
  command.option("SURVEY", options->survey, "The survey's file (TOML)").required();
  command.option("-o,--output", options->out, "The plan to write").required().type_name("PLAN.json");
  command.flag("--overwrite", options->overwrite, "Replace a plan that exists");
  command.runs([options] { return run_plan(*options); });
}

}  // namespace vegard::apps
