#include "fit/compare/robust_loss.h"

#include <cmath>

namespace vegard::fit {

RobustLoss::RobustLoss(const sim::Fit& fit) : kind_(fit.loss), d_(fit.loss_sigma) {}

double RobustLoss::residual(double r) const {
  const double size = std::abs(r);
  if (kind_ == sim::ResidualLoss::huber && size > d_)
    return std::copysign(std::sqrt(2.0 * d_ * size - d_ * d_), r);
  if (kind_ == sim::ResidualLoss::cauchy)
    return std::copysign(d_ * std::sqrt(std::log1p(r * r / (d_ * d_))), r);
  return r;
}

double RobustLoss::slope(double r) const {
  const double size = std::abs(r);
  if (kind_ == sim::ResidualLoss::huber && size > d_) return d_ / std::sqrt(2.0 * d_ * size - d_ * d_);
  // Near 0 the root of the logarithm is the residual itself.
  if (kind_ == sim::ResidualLoss::cauchy && size > 1e-6 * d_)
    return size / (1.0 + r * r / (d_ * d_)) / std::abs(residual(r));
  return 1.0;
}

}  // namespace vegard::fit
