#include "fit/profile_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace vegard::fit {
namespace {

std::vector<int> all_or(const std::vector<int>& some, std::size_t count) {
  if (!some.empty()) return some;
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<FreeNumber> picked(const std::vector<FreeNumber>& free, const std::vector<int>& which) {
  std::vector<FreeNumber> some;
  for (const int j : which) some.push_back(free[j]);
  return some;
}

}  // namespace

ProfileCost::ProfileCost(const std::vector<FreeNumber>& free, const std::vector<CostTerm>& terms,
                         EvaluationLog& log, const Options& options)
    : terms_(terms),
      log_(log),
      held_(options.held),
      which_(all_or(options.moved, free.size())),
      moved_(picked(free, which_)),
      priors_(moved_) {
  append_rows(options.prior, terms_.front().scene, options.prior_weight, priors_);
  for (const CostTerm& term : terms_) data_residuals_ += term.comparison->residuals();
  set_num_residuals(data_residuals_ + static_cast<int>(priors_.count()));
  mutable_parameter_block_sizes()->push_back(static_cast<int>(moved_.size()));
}

ProfileCost::ProfileCost(const std::vector<FreeNumber>& free, const std::vector<CostTerm>& terms,
                         EvaluationLog& log)
    : ProfileCost(free, terms, log, Options()) {}

std::vector<double> ProfileCost::all_values(const std::vector<double>& values) const {
  if (held_.empty()) return values;
  std::vector<double> all = held_;
  for (std::size_t k = 0; k < which_.size(); ++k) all[which_[k]] = values[k];
  return all;
}

ProfileCost::Point ProfileCost::at(const std::vector<double>& values, bool with_derivatives) const {
  Point point;
  point.values = values;
  const std::vector<double> all = all_values(values);
  for (const CostTerm& term : terms_) {
    sim::Scene scene = term.scene;
    const bool within_limits = term.map.put(all, scene);
    point.of_photo.push_back(with_derivatives
                                 ? term.comparison->at(scene, term.map.motion(all, which_, scene))
                                 : term.comparison->at(scene));
    point.chi2 += point.of_photo.back().chi2;
    if (!within_limits) point.chi2 = std::numeric_limits<double>::infinity();
  }
  std::vector<double> of_priors;
  priors_.evaluate(values, of_priors, nullptr);
  for (const double residual : of_priors) point.chi2 += residual * residual;
  ++log_.residuals;
  log_.jacobians += with_derivatives;
  return point;
}

void ProfileCost::data_jacobian(const Point& point, std::vector<double>& out) const {
  out.clear();
  out.reserve(static_cast<std::size_t>(data_residuals_) * moved_.size());
  std::vector<double> part;
  for (std::size_t t = 0; t < terms_.size(); ++t) {
    terms_[t].comparison->jacobian(point.of_photo[t], part);
    if (terms_.size() == 1) {
      out.swap(part);
      return;
    }
    out.insert(out.end(), part.begin(), part.end());
  }
}

std::vector<double> ProfileCost::data_residual(const Point& point) const {
  std::vector<double> all;
  for (const Comparison::Point& of_photo : point.of_photo)
    all.insert(all.end(), of_photo.residual().begin(), of_photo.residual().end());
  return all;
}

bool ProfileCost::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  const std::size_t p = moved_.size();
  std::vector<double> values(p), slopes(p);
  for (std::size_t j = 0; j < p; ++j) {
    values[j] = moved_[j].value(parameters[0][j]);
    slopes[j] = moved_[j].slope(parameters[0][j]);
  }
  const bool with_derivatives = jacobians != nullptr && jacobians[0] != nullptr;
  // Of a trial step Ceres takes the refusal quietly, and its callback then ends the descent. A Jacobian that
  // is refused it calls a failure, and writes so to stderr, whatever the logging type.
  if (log_.exhausted() && !with_derivatives) return false;
  const Point point = at(values, with_derivatives);
  if (!std::isfinite(point.chi2)) return false;

  const std::vector<double> of_data = data_residual(point);
  std::copy(of_data.begin(), of_data.end(), residuals);
  if (with_derivatives) {
    std::vector<double> by_value;
    data_jacobian(point, by_value);
    for (std::size_t k = 0; k < of_data.size(); ++k)
      for (std::size_t j = 0; j < p; ++j) jacobians[0][k * p + j] = by_value[k * p + j] * slopes[j];
  }
  std::vector<double> of_priors, by_value;
  priors_.evaluate(values, of_priors, with_derivatives ? &by_value : nullptr);
  const std::size_t first = of_data.size();
  std::copy(of_priors.begin(), of_priors.end(), residuals + first);
  for (std::size_t i = 0; i < by_value.size(); ++i) jacobians[0][first * p + i] = by_value[i] * slopes[i % p];
  return true;
}

}  // namespace vegard::fit
