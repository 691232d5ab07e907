#include "fit/measure/guide_curve.h"

#include <algorithm>
#include <cmath>

namespace vegard::fit {
namespace {

/// Second derivatives of the natural cubic spline at its knots, by Thomas' elimination.
std::vector<double> bends(const std::vector<double>& t, const std::vector<double>& value) {
  const std::size_t n = t.size();
  std::vector<double> bend(n, 0.0), diagonal(n, 1.0), right(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = t[i] - t[i - 1], after = t[i + 1] - t[i];
    diagonal[i] = 2.0 * (before + after);
    right[i] = 6.0 * ((value[i + 1] - value[i]) / after - (value[i] - value[i - 1]) / before);
    if (i > 1) {
      const double share = before / diagonal[i - 1];
      diagonal[i] -= share * before;
      right[i] -= share * right[i - 1];
    }
  }
  for (std::size_t i = n - 1; i-- > 1;) bend[i] = (right[i] - (t[i + 1] - t[i]) * bend[i + 1]) / diagonal[i];
  return bend;
}

double on_piece(const std::vector<double>& t, const std::vector<double>& value,
                const std::vector<double>& bend, std::size_t piece, double at) {
  const double width = t[piece + 1] - t[piece], b = (at - t[piece]) / width, a = 1.0 - b;
  return a * value[piece] + b * value[piece + 1] +
         ((a * a * a - a) * bend[piece] + (b * b * b - b) * bend[piece + 1]) * width * width / 6.0;
}

}  // namespace

GuideCurve::GuideCurve(const std::vector<double>& x_px, const std::vector<double>& y_px) {
  std::vector<double> t(x_px.size(), 0.0);
  for (std::size_t i = 1; i < t.size(); ++i)
    t[i] = t[i - 1] + std::hypot(x_px[i] - x_px[i - 1], y_px[i] - y_px[i - 1]);
  const std::vector<double> bend_x = bends(t, x_px), bend_y = bends(t, y_px);
  x_.push_back(x_px.front());
  y_.push_back(y_px.front());
  // A spline may be longer than its chord: twice as many samples as that would need.
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    const int steps = std::max(4, static_cast<int>(std::ceil(2.0 * (t[i + 1] - t[i]) / kSpacing_px)));
    for (int k = 1; k <= steps; ++k) {
      const double at = t[i] + (t[i + 1] - t[i]) * k / steps;
      x_.push_back(on_piece(t, x_px, bend_x, i, at));
      y_.push_back(on_piece(t, y_px, bend_y, i, at));
    }
  }
  length_.assign(x_.size(), 0.0);
  for (std::size_t k = 1; k < x_.size(); ++k)
    length_[k] = length_[k - 1] + std::hypot(x_[k] - x_[k - 1], y_[k] - y_[k - 1]);
}

GuideCurve::Nearest GuideCurve::nearest(std::size_t k, double x_px, double y_px) const {
  Nearest best;
  double least = INFINITY;
  for (std::size_t piece = k > 0 ? k - 1 : 0; piece <= k && piece + 1 < x_.size(); ++piece) {
    const double dx = x_[piece + 1] - x_[piece], dy = y_[piece + 1] - y_[piece];
    const double px = x_px - x_[piece], py = y_px - y_[piece];
    const double length = length_[piece + 1] - length_[piece];
    if (!(length > 0.0)) continue;
    const double along = (px * dx + py * dy) / (length * length), share = std::clamp(along, 0.0, 1.0);
    const double distance = std::hypot(px - share * dx, py - share * dy);
    if (distance >= least) continue;
    least = distance;
    best.along_px = length_[piece] + share * length;
    // Rows count downwards: the right-hand side of (dx, dy) is (-dy, dx).
    best.across_px = std::copysign(distance, dx * py - dy * px);
    best.beyond = (piece == 0 && along < 0.0) || (piece + 2 == x_.size() && along > 1.0);
  }
  return best;
}

}  // namespace vegard::fit
