// Surveys as files (TOML): docs/surveys.md has the keys.
#pragma once

#include <string>

#include "fit/survey/survey.h"

namespace vegard::fit {

/// Throws sim::Error(unreadable_input) if there is no such file, and (scene), with file, line, key, what was
/// expected and a hint, for what is no survey. Files that it names are not looked at.
Survey read_survey(const std::string& file);

/// The same of a text; `file` stands for it in messages and in Survey::place().
Survey parse_survey(const std::string& text, const std::string& file);

}  // namespace vegard::fit
