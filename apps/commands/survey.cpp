// vegard survey: many frames of several cameras.
#include "apps/commands/commands.h"
#include "apps/commands/survey/steps.h"

namespace vegard::apps {

void add_survey_command(Program& program) {
  const Command survey = program.add(
      "survey",
      "Measure every frame of a night, a winter or a network of cameras, on one machine or a cluster");
  add_survey_plan(survey);
  add_survey_run(survey);
  add_survey_submit(survey);
  add_survey_status(survey);
  add_survey_cancel(survey);
  add_survey_merge(survey);
  add_survey_export(survey);
  add_survey_smooth(survey);
  add_survey_report(survey);
}

}  // namespace vegard::apps
