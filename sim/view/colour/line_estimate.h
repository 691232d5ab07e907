// Estimates the rayleighs of lines from three colour channels, with their covariance.
//
// Source: linear least squares, weighted by the channels' inverse covariance (Aitken 1936,
// doi:10.1017/S0370164600014346). Three channels can separate three lines; for three lines the estimate is
// the exact inverse, for any weights. Estimates may be negative: clipping would bias means.
#pragma once

#include <vector>

#include "sim/view/colour/matrix3.h"

namespace vegard::sim {

struct LineEstimate {
  std::vector<double> rayleigh;                 ///< per line
  std::vector<std::vector<double>> covariance;  ///< rayleigh^2, [line][line]
};

class LineEstimator {
 public:
  /// `rgb_per_rayleigh`: linear, signed RGB of each of one to three lines (line_colours() / 1000). Throws
  /// Error(scene) with key "emission.lines" for more lines, and for lines whose colours the sensor cannot
  /// distinguish: if the unit vector of one colour has a component of less than 1e-3 orthogonal to the
  /// others.
  explicit LineEstimator(std::vector<Vector3> rgb_per_rayleigh);

  /// Estimates from channels with this covariance, which must have an inverse.
  LineEstimate estimate(const Vector3& rgb, const Matrix3& covariance) const;

  /// The same for channels with independent noise; sigmas must be above 0.
  LineEstimate estimate(const Vector3& rgb, const Vector3& sigma) const;

  int lines() const { return static_cast<int>(rgb_.size()); }

 private:
  std::vector<Vector3> rgb_;
};

}  // namespace vegard::sim
