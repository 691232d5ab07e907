// Ranks of brightness: what is left of a picture whatever its gain and tone curve, if that only grows; and
// how many of them are independent.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace vegard::fit {

/// Returns the ranks of values, from -1 to below 1; of equal values the mean rank.
Eigen::VectorXd ranks_of(const std::vector<double>& values);

/// Returns the place of the largest value near number `best`, by a parabola through it and its neighbours;
/// `at` has equal steps. At an end, or where there is no maximum, it is at[best].
double refined_maximum(const std::vector<double>& at, const std::vector<double>& value, std::size_t best);

/// Returns how many independent values there are on a grid, NaN where nothing is known, row after row: their
/// number over the integral of the square of their autocorrelation (M. S. Bartlett, Journal of the Royal
/// Statistical Society 98, 1935), which for a Gaussian one that falls to a half at the lags a and b is
/// 2.27 a b. 0 if nothing is known.
double independent_values(const std::vector<double>& grid, std::size_t rows, std::size_t columns);

}  // namespace vegard::fit
