// Reads and writes plans of surveys as JSON files, whose format docs/file_formats.md describes.
#pragma once

#include <string>

#include "fit/survey/survey_plan.h"

namespace vegard::fit {

/// Returns a plan as JSON, with one line per block. The same plan gives the same bytes; all numbers are
/// restored exactly.
std::string plan_json(const SurveyPlan& plan);

/// Parses a plan. Throws sim::Error(unreadable_input) with the name `file` if the text is not a plan, or one
/// of another version of the format.
SurveyPlan plan_of_json(const std::string& json, const std::string& file);

/// Reads a plan from a file. Throws as plan_of_json().
SurveyPlan read_plan(const std::string& file);

}  // namespace vegard::fit
