// The relative gradient of chi2 at the end of a descent: a measure of convergence that does not depend on
// units.
#pragma once

#include <ceres/cost_function.h>

#include <vector>

#include "fit/compare/profile_cost.h"

namespace vegard::fit {

/// Returns the largest |cos| of the angle between the residuals and a column of the Jacobian. Its square is
/// the share of chi2 that a change of this one coordinate would remove if the model were linear: 0 at a
/// minimum, 1 if one coordinate could remove all of chi2. Columns that are 0, and those marked in `left_out`,
/// are ignored; NaN if none remains, or if the cost cannot be evaluated.
double gradient_cosine(const ceres::CostFunction& cost, const std::vector<double>& coordinates,
                       const std::vector<bool>& left_out = {});

/// Returns it for a fit's cost at these values, without the parameters that are at a limit.
double gradient_cosine(const ProfileCost& cost, const std::vector<double>& values);

}  // namespace vegard::fit
