// A smooth curve through points that were drawn by hand on a photograph.
#pragma once

#include <cstddef>
#include <vector>

namespace vegard::fit {

/// The natural cubic spline through the points, by the length of the chords between them: of all curves
/// through them, about the one that is bent least. Places are pixels, x to the right and y down.
class GuideCurve {
 public:
  /// At least two points; no two neighbours may be the same.
  GuideCurve(const std::vector<double>& x_px, const std::vector<double>& y_px);

  double length_px() const { return length_.back(); }

  /// Samples, at most kSpacing_px apart, and how far along the curve they are.
  static constexpr double kSpacing_px = 0.25;
  std::size_t samples() const { return x_.size(); }
  double x(std::size_t k) const { return x_[k]; }
  double y(std::size_t k) const { return y_[k]; }
  double length(std::size_t k) const { return length_[k]; }

  /// A place as the curve sees it.
  struct Nearest {
    double along_px = 0.0;   ///< of the nearest place of the curve, from its start
    double across_px = 0.0;  ///< distance from there, positive to the right of who walks along it
    bool beyond = false;     ///< the nearest place is an end, and the place lies beyond it
  };
  /// On the pieces next to sample `k`, which is to be the nearest sample.
  Nearest nearest(std::size_t k, double x_px, double y_px) const;

 private:
  std::vector<double> x_, y_, length_;
};

}  // namespace vegard::fit
