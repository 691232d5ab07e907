// The relative gradient of chi2 at the end of a descent: a measure of convergence that does not depend on
// units.
#pragma once

#include <ceres/cost_function.h>

#include <vector>

#include "fit/compare/profile_cost.h"

namespace vegard::fit {

/// Largest |cos| of the angle between the residuals and a column of the Jacobian. Its square is the share of
/// chi2 that moving this one coordinate would take away, were the model linear: 0 at a minimum, 1 where one
/// coordinate could remove all. Columns without effect, and those of `left_out`, do not count; NaN if none is
/// left, or the cost cannot be evaluated.
double gradient_cosine(const ceres::CostFunction& cost, const std::vector<double>& coordinates,
                       const std::vector<bool>& left_out = {});

/// The same of a fit's cost at some values; parameters at a limit are left out, which press against it.
double gradient_cosine(const ProfileCost& cost, const std::vector<double>& values);

}  // namespace vegard::fit
