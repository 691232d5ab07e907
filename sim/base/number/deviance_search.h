// Finds the minimum of an expensive function of one or two numbers, and its curvature there.
//
// The search fits a parabola to a few points around the best one so far, goes to its minimum, and repeats.
// The points are about one standard deviation apart: the function has noise, because it is the result of
// descents that may end a little early, and over such a distance the noise is negligible.
#pragma once

#include <functional>
#include <vector>

namespace vegard::sim {

/// One evaluation.
struct DevianceTrial {
  std::vector<double> at;
  double value = 0.0;            ///< -2 ln(likelihood), times `correlated`
  double correlated = 1.0;       ///< number of data that are fully correlated
  std::vector<double> solution;  ///< all other parameters, fitted at this point
};

struct DevianceMinimum {
  std::vector<double> at;
  /// Of `at`. The limits bound directions that the function does not determine, with a uniform prior between
  /// them.
  std::vector<std::vector<double>> covariance;
  std::vector<bool> at_limit;
  std::vector<bool> undetermined;  ///< the variance is more than a quarter of that of the uniform prior
  bool converged = false;
  DevianceTrial centre;                     ///< the trial nearest to `at`
  std::vector<std::vector<double>> slopes;  ///< [number][solution]: d solution / d number
  std::vector<DevianceTrial> trials;        ///< all trials, in order
};

/// Searches between -limit and limit in every number, from the point `start`. `evaluate` gets the point and
/// the nearest trial so far (null at first); an infinite value ends the search.
using EvaluateDeviance =
    std::function<DevianceTrial(const std::vector<double>& at, const DevianceTrial* nearest)>;
DevianceMinimum deviance_minimum(const std::vector<double>& start, double limit,
                                 const EvaluateDeviance& evaluate);

}  // namespace vegard::sim
