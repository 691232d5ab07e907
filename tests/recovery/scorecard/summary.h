// Cards as tables.
#pragma once

#include <string>
#include <vector>

#include "tests/recovery/scorecard/card.h"

namespace vegard::scorecard {

/// Markdown: recovered by class, criteria, verdict against recovery, coverage, cost, and the failures one by
/// one. What counts as recovered is worked out again from the numbers.
std::string summary(const std::vector<Row>& rows);

}  // namespace vegard::scorecard
