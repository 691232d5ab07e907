// The steps of the selection of a map's curves, as text and as a table.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// "start", "drop", "add".
const char* change_name(CurtainStep::Change change);

/// "curtain_2 stays: BIC would be 812 higher without it (very strong evidence)".
std::string curtain_step_in_words(const CurtainStep& step);

/// An HTML table with one row per step; empty if there are none.
std::string curtain_steps_table(const FitResult& result);

}  // namespace vegard::fit
