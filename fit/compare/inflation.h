// How much wider the error bars of correlated residuals must be.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/measure/profile.h"

namespace vegard::fit {

/// How much wider error bars must be than independent, right-sized residuals would have them: the square root
/// of max(1, chi2 / dof) times the number of residuals that go up and down together. That number is taken
/// from the residuals' autocorrelation down the rows (the largest partial sum, to a quarter of the rows)
/// times that across channels and to the neighbouring band.
double error_inflation(const Profile& data, const std::vector<std::size_t>& used,
                       const std::vector<double>& residual, int dof);

}  // namespace vegard::fit
