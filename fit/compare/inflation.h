// The error bars' inflation of all photographs of a cost together.
#pragma once

#include "fit/compare/profile_cost.h"

namespace vegard::fit {

/// Mean square of the photographs' own error_inflation() (fit/uncertainty/uncertainty.h), by their number of
/// residuals. `unknowns` are all that were found from the data.
double joint_inflation(const ProfileCost& cost, const ProfileCost::Point& point, int unknowns);

}  // namespace vegard::fit
