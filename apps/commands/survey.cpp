// vegard survey: many frames of several cameras.
#include "apps/commands/commands.h"
#include "apps/commands/survey/steps.h"

namespace vegard::apps {

void add_survey_command(Program& program) {
  const Command survey = program.add(
      "survey",
      "Measure every frame of a night, a winter or a network of cameras, on one machine or a cluster");
  for (AddSurveyStep* const add :
       {add_survey_plan, add_survey_run, add_survey_submit, add_survey_status, add_survey_cancel,
        add_survey_merge, add_survey_export, add_survey_smooth, add_survey_report})
    add(survey);
}

}  // namespace vegard::apps
