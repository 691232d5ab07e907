// The steps of a survey, each a subcommand of `vegard survey`.
#pragma once

#include "apps/options/command.h"

namespace vegard::apps {

using AddSurveyStep = void(const Command& survey);
AddSurveyStep add_survey_plan, add_survey_run, add_survey_submit, add_survey_status, add_survey_cancel;
/// What is done with the database of a survey, or of one of its shards (database.cpp).
AddSurveyStep add_survey_merge, add_survey_export, add_survey_smooth, add_survey_report;

}  // namespace vegard::apps
