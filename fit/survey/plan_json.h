// Plans of surveys as files (JSON): docs/file_formats.md has what is in them.
#pragma once

#include <string>

#include "fit/survey/survey_plan.h"

namespace vegard::fit {

/// A line a block. The same plan gives the same bytes; every number comes back exactly.
std::string plan_json(const SurveyPlan& plan);

/// Throws sim::Error(unreadable_input) that names `file` for what is no plan, or one of another format.
SurveyPlan plan_of_json(const std::string& json, const std::string& file);

/// The same of a file.
SurveyPlan read_plan(const std::string& file);

}  // namespace vegard::fit
