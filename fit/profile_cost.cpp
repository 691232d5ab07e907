#include "fit/profile_cost.h"

#include <algorithm>
#include <cmath>

namespace vegard::fit {

ProfileCost::ProfileCost(const sim::Scene& base, const std::vector<FreeNumber>& free, ProfileModel& model,
                         const LinearPart& linear, EvaluationLog& log)
    : base_(base), free_(free), model_(model), linear_(linear), log_(log) {
  int priors = 0;
  for (const FreeNumber& number : free) priors += number.prior.has_value();
  set_num_residuals(linear.residuals() + priors);
  mutable_parameter_block_sizes()->push_back(static_cast<int>(free.size()));
}

ProfileCost::Point ProfileCost::at(const std::vector<double>& values, bool with_derivatives) const {
  sim::Scene scene = base_;
  put_values(scene, free_, values);
  Point point;
  point.values = values;
  if (with_derivatives)
    model_.evaluate_with_derivatives(scene, addresses(scene, free_), point.aurora);
  else
    model_.evaluate(scene, point.aurora);
  point.solution = linear_.solve(point.aurora);
  point.chi2 = point.solution.chi2;
  for (std::size_t j = 0; j < free_.size(); ++j)
    if (free_[j].prior) point.chi2 += std::pow((values[j] - free_[j].prior->mean) / free_[j].prior->sigma, 2);
  ++log_.residuals;
  log_.jacobians += with_derivatives;
  return point;
}

bool ProfileCost::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  const std::size_t p = free_.size();
  std::vector<double> values(p);
  for (std::size_t j = 0; j < p; ++j) values[j] = free_[j].value(parameters[0][j]);
  const bool with_derivatives = jacobians != nullptr && jacobians[0] != nullptr;
  // Of a trial step Ceres takes the refusal quietly, and its callback then ends the descent. A Jacobian that
  // is refused it calls a failure, and writes so to stderr, whatever the logging type.
  if (log_.exhausted() && !with_derivatives) return false;
  const Point point = at(values, with_derivatives);
  if (!std::isfinite(point.chi2)) return false;

  std::copy(point.solution.residual.begin(), point.solution.residual.end(), residuals);
  if (with_derivatives) {
    std::vector<double> by_value;
    linear_.jacobian(point.aurora, point.solution, by_value);
    for (std::size_t k = 0; k < point.solution.residual.size(); ++k)
      for (std::size_t j = 0; j < p; ++j)
        jacobians[0][k * p + j] = by_value[k * p + j] * free_[j].slope(parameters[0][j]);
  }
  std::size_t row = point.solution.residual.size();
  for (std::size_t j = 0; j < p; ++j) {
    if (!free_[j].prior) continue;
    residuals[row] = (values[j] - free_[j].prior->mean) / free_[j].prior->sigma;
    if (with_derivatives) {
      for (std::size_t i = 0; i < p; ++i) jacobians[0][row * p + i] = 0.0;
      jacobians[0][row * p + j] = free_[j].slope(parameters[0][j]) / free_[j].prior->sigma;
    }
    ++row;
  }
  return true;
}

}  // namespace vegard::fit
