#include "fit/compare/robust_loss.h"

#include <cmath>

namespace vegard::fit {

RobustLoss::RobustLoss(const sim::Fit& fit) : d_(fit.loss_sigma) {
  if (fit.loss == "huber") kind_ = Kind::huber;
  if (fit.loss == "cauchy") kind_ = Kind::cauchy;
}

double RobustLoss::residual(double r) const {
  const double size = std::abs(r);
  if (kind_ == Kind::huber && size > d_) return std::copysign(std::sqrt(2.0 * d_ * size - d_ * d_), r);
  if (kind_ == Kind::cauchy) return std::copysign(d_ * std::sqrt(std::log1p(r * r / (d_ * d_))), r);
  return r;
}

double RobustLoss::slope(double r) const {
  const double size = std::abs(r);
  if (kind_ == Kind::huber && size > d_) return d_ / std::sqrt(2.0 * d_ * size - d_ * d_);
  // Near 0 the root of the logarithm is the residual itself.
  if (kind_ == Kind::cauchy && size > 1e-6 * d_)
    return size / (1.0 + r * r / (d_ * d_)) / std::abs(residual(r));
  return 1.0;
}

}  // namespace vegard::fit
