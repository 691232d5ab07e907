#include "sim/base/number/spline.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace vegard::sim {

std::vector<double> spline_curvature(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  assert(n >= 2 && y.size() == n);
  std::vector<double> curvature(n, 0.0), scratch(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double left = x[i] - x[i - 1], right = x[i + 1] - x[i];
    const double share = left / (left + right);
    const double pivot = share * curvature[i - 1] + 2.0;
    curvature[i] = (share - 1.0) / pivot;
    const double bend = (y[i + 1] - y[i]) / right - (y[i] - y[i - 1]) / left;
    scratch[i] = (6.0 * bend / (left + right) - share * scratch[i - 1]) / pivot;
  }
  curvature[n - 1] = 0.0;
  for (std::size_t i = n - 1; i-- > 0;) curvature[i] = curvature[i] * curvature[i + 1] + scratch[i];
  curvature[0] = 0.0;
  return curvature;
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

}  // namespace vegard::sim
