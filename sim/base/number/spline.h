// Cubic splines on any increasing knots, natural or with given slopes at their ends.
#pragma once

#include <vector>

namespace vegard::sim {

/// Second derivatives at the knots of the natural cubic spline through (x[i], y[i]); x increasing, at least 2
/// knots. The spline is a linear function of y. Source: de Boor, "A Practical Guide to Splines", chapter IV.
std::vector<double> spline_curvature(const std::vector<double>& x, const std::vector<double>& y);

/// The same of the spline whose slopes at the first and the last knot are given.
std::vector<double> clamped_spline_curvature(const std::vector<double>& x, const std::vector<double>& y,
                                             double first_slope, double last_slope);

struct SplineValue {
  double value = 0.0;
  double slope = 0.0;  ///< with respect to the argument
};

/// The spline at `at`, continued beyond the ends by its end pieces.
SplineValue spline_at(const std::vector<double>& x, const std::vector<double>& y,
                      const std::vector<double>& curvature, double at);

/// The same with as many values and curvatures as there are knots, wherever they lie.
SplineValue spline_at(const std::vector<double>& x, const double* y, const double* curvature, double at);

/// Its integral from the first knot to `at`, between the first knot and the last.
double spline_integral(const std::vector<double>& x, const std::vector<double>& y,
                       const std::vector<double>& curvature, double at);

}  // namespace vegard::sim
