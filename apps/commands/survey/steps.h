// The steps of a survey, each a subcommand of `vegard survey` in a file of its own in this folder.
#pragma once

#include "apps/options/command.h"

namespace vegard::apps {

void add_survey_plan(const Command& survey);
void add_survey_run(const Command& survey);
void add_survey_submit(const Command& survey);
void add_survey_status(const Command& survey);
void add_survey_cancel(const Command& survey);
void add_survey_merge(const Command& survey);
void add_survey_export(const Command& survey);
void add_survey_smooth(const Command& survey);
void add_survey_report(const Command& survey);

}  // namespace vegard::apps
