// Reads surveys from TOML files; docs/surveys.md describes the keys.
#pragma once

#include <string>

#include "fit/survey/survey.h"

namespace vegard::fit {

/// Reads a survey. Throws sim::Error(unreadable_input) if the file does not exist, and (scene), with file,
/// line, key, what was expected and a hint, if it is not a valid survey. Files that the survey names are not
/// opened.
Survey read_survey(const std::string& file);

/// Like read_survey(), for a text; `file` is its name in messages and for Survey::place().
Survey parse_survey(const std::string& text, const std::string& file);

}  // namespace vegard::fit
