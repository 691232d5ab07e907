// A smooth curve through points that were drawn by hand on a photograph.
#pragma once

#include <cstddef>
#include <vector>

namespace vegard::fit {

/// The natural cubic spline through the points, parametrised by the length of the chords between them: nearly
/// the least curved of all curves through them. Coordinates are pixels, x to the right and y down.
class GuideCurve {
 public:
  /// At least two points; no two neighbours may be the same.
  GuideCurve(const std::vector<double>& x_px, const std::vector<double>& y_px);

  double length_px() const { return length_.back(); }

  /// Samples of the curve, at most kSpacing_px apart, with their distance along it.
  static constexpr double kSpacing_px = 0.25;
  std::size_t samples() const { return x_.size(); }
  double x(std::size_t k) const { return x_[k]; }
  double y(std::size_t k) const { return y_[k]; }
  double length(std::size_t k) const { return length_[k]; }

  /// A point in the coordinates of the curve.
  struct Nearest {
    double along_px = 0.0;   ///< distance along the curve, from its start, of the curve's nearest point
    double across_px = 0.0;  ///< distance from the curve, positive on its right in the direction of the curve
    bool beyond = false;     ///< the nearest point is an end of the curve, and the point lies beyond it
  };
  /// Finds the nearest point on the pieces next to sample `k`, which must be the nearest sample.
  Nearest nearest(std::size_t k, double x_px, double y_px) const;

 private:
  std::vector<double> x_, y_, length_;
};

}  // namespace vegard::fit
