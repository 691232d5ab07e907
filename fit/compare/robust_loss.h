// Robust losses reduce the weight of outliers among the residuals.
#pragma once

#include <vector>

#include "sim/scene/structs/fit.h"

namespace vegard::fit {

/// Residuals r become sign(r) sqrt(rho(r^2)), whose squares add up to the robust chi2. Huber (1964,
/// doi:10.1214/aoms/1177703732): rho = r^2 up to d, then 2 d |r| - d^2; Cauchy: rho = d^2 ln(1 + r^2 / d^2);
/// d is fit.loss_sigma. Gains and sky are solved for without it.
class RobustLoss {
 public:
  explicit RobustLoss(const sim::Fit& fit);

  bool any() const { return kind_ != sim::ResidualLoss::none; }
  double residual(double r) const;
  double slope(double r) const;  ///< d residual(r) / d r, above 0

 private:
  sim::ResidualLoss kind_;
  double d_;
};

}  // namespace vegard::fit
