#include "fit/profile_cost.h"

#include <algorithm>
#include <cmath>

namespace vegard::fit {

ProfileCost::ProfileCost(const sim::Scene& base, const std::vector<FreeNumber>& free, ProfileModel& model,
                         const LinearPart& linear, EvaluationLog& log, const SplinePrior& prior,
                         double prior_weight)
    : base_(base), free_(free), model_(model), linear_(linear), log_(log), priors_(free) {
  append_rows(prior, base, prior_weight, priors_);
  set_num_residuals(linear.residuals() + static_cast<int>(priors_.count()));
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
  std::vector<double> of_priors;
  priors_.evaluate(values, of_priors, nullptr);
  for (const double residual : of_priors) point.chi2 += residual * residual;
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
  std::vector<double> of_priors, by_value;
  priors_.evaluate(values, of_priors, with_derivatives ? &by_value : nullptr);
  const std::size_t first = point.solution.residual.size();
  std::copy(of_priors.begin(), of_priors.end(), residuals + first);
  for (std::size_t i = 0; i < by_value.size(); ++i)
    jacobians[0][first * p + i] = by_value[i] * free_[i % p].slope(parameters[0][i % p]);
  return true;
}

}  // namespace vegard::fit
