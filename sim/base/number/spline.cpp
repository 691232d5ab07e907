#include "sim/base/number/spline.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace vegard::sim {

namespace {

/// The first and the last row of the elimination: curvature[0] = factor * curvature[1] + constant, and the
/// last row curvature[n - 1] + share * curvature[n - 2] = constant.
struct SplineEnds {
  double first_factor = 0.0, first_constant = 0.0, last_share = 0.0, last_constant = 0.0;
};

std::vector<double> curvature_between(const std::vector<double>& x, const std::vector<double>& y,
                                      const SplineEnds& ends) {
  const std::size_t n = x.size();
  assert(n >= 2 && y.size() == n);
  std::vector<double> curvature(n, 0.0), scratch(n, 0.0);
  curvature[0] = ends.first_factor;
  scratch[0] = ends.first_constant;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double left = x[i] - x[i - 1], right = x[i + 1] - x[i];
    const double share = left / (left + right);
    const double pivot = share * curvature[i - 1] + 2.0;
    curvature[i] = (share - 1.0) / pivot;
    const double bend = (y[i + 1] - y[i]) / right - (y[i] - y[i - 1]) / left;
    scratch[i] = (6.0 * bend / (left + right) - share * scratch[i - 1]) / pivot;
  }
  curvature[n - 1] =
      (ends.last_constant - ends.last_share * scratch[n - 2]) / (1.0 + ends.last_share * curvature[n - 2]);
  for (std::size_t i = n - 1; i-- > 0;) curvature[i] = curvature[i] * curvature[i + 1] + scratch[i];
  return curvature;
}

}  // namespace

std::vector<double> spline_curvature(const std::vector<double>& x, const std::vector<double>& y) {
  return curvature_between(x, y, {});
}

std::vector<double> clamped_spline_curvature(const std::vector<double>& x, const std::vector<double>& y,
                                             double first_slope, double last_slope) {
  const std::size_t last = x.size() - 1;
  const double first_step = x[1] - x[0], last_step = x[last] - x[last - 1];
  SplineEnds ends;
  ends.first_factor = -0.5;
  ends.first_constant = 3.0 / first_step * ((y[1] - y[0]) / first_step - first_slope);
  ends.last_share = 0.5;
  ends.last_constant = 3.0 / last_step * (last_slope - (y[last] - y[last - 1]) / last_step);
  return curvature_between(x, y, ends);
}

SplineValue spline_at(const std::vector<double>& x, const std::vector<double>& y,
                      const std::vector<double>& curvature, double at) {
  return spline_at(x, y.data(), curvature.data(), at);
}

SplineValue spline_at(const std::vector<double>& x, const double* y, const double* curvature, double at) {
  const auto upper = std::upper_bound(x.begin() + 1, x.end() - 1, at);
  const std::size_t i = static_cast<std::size_t>(upper - x.begin()) - 1;
  const double h = x[i + 1] - x[i];
  const double a = (x[i + 1] - at) / h, b = (at - x[i]) / h;
  SplineValue r;
  r.value = a * y[i] + b * y[i + 1] +
            ((a * a * a - a) * curvature[i] + (b * b * b - b) * curvature[i + 1]) * h * h / 6.0;
  r.slope = (y[i + 1] - y[i]) / h +
            ((3.0 * b * b - 1.0) * curvature[i + 1] - (3.0 * a * a - 1.0) * curvature[i]) * h / 6.0;
  return r;
}

double spline_integral(const std::vector<double>& x, const std::vector<double>& y,
                       const std::vector<double>& curvature, double at) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < x.size() && at > x[i]; ++i) {
    const double h = x[i + 1] - x[i];
    const double b = (std::min(at, x[i + 1]) - x[i]) / h, a = 1.0 - b;
    const double a2 = a * a, b2 = b * b;
    // Integrals of a, b, a^3 - a and b^3 - b over the piece, in units of its length.
    sum += h * (0.5 * (1.0 - a2) * y[i] + 0.5 * b2 * y[i + 1] +
                h * h / 6.0 *
                    ((0.5 * a2 - 0.25 * a2 * a2 - 0.25) * curvature[i] +
                     (0.25 * b2 * b2 - 0.5 * b2) * curvature[i + 1]));
  }
  return sum;
}

}  // namespace vegard::sim
