// The lowest place of a function of one or two numbers that is dear to evaluate, and how sharp it is there.
//
// A parabola through a few places about the best one so far, a step to its bottom, and so on, with places
// about one standard deviation apart: descents that end a little early roughen the function, and over such a
// distance that does not show.
#pragma once

#include <functional>
#include <vector>

namespace vegard::sim {

/// One evaluation.
struct CurveTrial {
  std::vector<double> at;
  double value = 0.0;            ///< -2 ln likelihood, times `together`
  double together = 1.0;         ///< how many of the data go up and down as one
  std::vector<double> solution;  ///< where everything else has ended there
};

struct CurveMinimum {
  std::vector<double> at;
  /// Of `at`; what the function leaves open is bounded by the limits, between which all is alike likely.
  std::vector<std::vector<double>> covariance;
  std::vector<bool> at_limit;
  std::vector<bool> undetermined;  ///< more than a quarter of the variance inside the limits is left
  bool converged = false;
  CurveTrial centre;                        ///< the trial next to `at`
  std::vector<std::vector<double>> slopes;  ///< [number][solution]: d solution / d number
  std::vector<CurveTrial> trials;           ///< all, in their order
};

/// Looks between -limit and limit in every number, from the place `start`. `evaluate` gets the place and the
/// nearest trial so far (null at first); an infinite value ends the search where it is.
using EvaluateCurve = std::function<CurveTrial(const std::vector<double>& at, const CurveTrial* nearest)>;
CurveMinimum curve_minimum(const std::vector<double>& start, double limit, const EvaluateCurve& evaluate);

}  // namespace vegard::sim
