// Cubic splines on any increasing knots, natural or with given slopes at their ends.
#pragma once

#include <vector>

namespace vegard::sim {

/// Returns the second derivatives at the knots of the natural cubic spline through (x[i], y[i]); x
/// increasing, at least 2 knots. The spline is a linear function of y. Source: de Boor, "A Practical Guide to
/// Splines", chapter IV.
std::vector<double> spline_curvature(const std::vector<double>& x, const std::vector<double>& y);

/// The same for the spline with given slopes at the first and the last knot.
std::vector<double> clamped_spline_curvature(const std::vector<double>& x, const std::vector<double>& y,
                                             double first_slope, double last_slope);

struct SplineValue {
  double value = 0.0;
  double slope = 0.0;  ///< with respect to the argument
};

/// Evaluates the spline at `at`, extrapolated beyond the ends by its end pieces.
SplineValue spline_at(const std::vector<double>& x, const std::vector<double>& y,
                      const std::vector<double>& curvature, double at);

/// The same with pointers to the values and curvatures, as many as there are knots.
SplineValue spline_at(const std::vector<double>& x, const double* y, const double* curvature, double at);

/// Returns the spline's integral from the first knot to `at`, which must be between the first and the last
/// knot.
double spline_integral(const std::vector<double>& x, const std::vector<double>& y,
                       const std::vector<double>& curvature, double at);

}  // namespace vegard::sim
