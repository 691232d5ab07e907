// Ranks of brightness: what is left of a picture whatever its gain and tone curve, if that only grows.
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

}  // namespace vegard::fit
