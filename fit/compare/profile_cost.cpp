#include "fit/compare/profile_cost.h"

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
      loss_(terms.front().scene.fit),
      log_(log),
      held_(options.held),
      anchors_(options.anchors),
      prior_weight_(options.prior_weight),
      which_(all_or(options.moved, free.size())),
      moved_(picked(free, which_)),
      priors_(moved_, options.prior_weight) {
  append_rows(options.prior, terms_.front().scene, options.prior_weight, priors_);
  for (const CostTerm& term : terms_) data_residuals_ += term.comparison->residuals();
  const int of_radars = terms_.front().radar == nullptr ? 0 : terms_.front().radar->radars->rows();
  set_num_residuals(data_residuals_ + static_cast<int>(priors_.count()) + of_radars);
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

std::vector<double> ProfileCost::values(double const* coordinates) const {
  std::vector<double> values(moved_.size());
  for (std::size_t j = 0; j < values.size(); ++j) values[j] = moved_[j].value(coordinates[j]);
  for (const PhaseAnchor& a : anchors_) values[a.phase] -= a.more(values[a.wavelength]);
  return values;
}

std::vector<double> ProfileCost::coordinates(const std::vector<double>& values) const {
  std::vector<double> in_view = values;
  for (const PhaseAnchor& a : anchors_) in_view[a.phase] += a.more(values[a.wavelength]);
  for (std::size_t j = 0; j < in_view.size(); ++j) in_view[j] = moved_[j].coordinate(in_view[j]);
  return in_view;
}

ProfileCost::Point ProfileCost::at(const std::vector<double>& values, bool with_derivatives) const {
  Point point;
  point.values = values;
  const std::vector<double> all = all_values(values);
  for (const CostTerm& term : terms_) {
    sim::Scene scene = term.scene;
    const bool within_limits = term.map.put(all, scene);
    point.by_photo.push_back(with_derivatives
                                 ? term.comparison->at(scene, term.map.motion(all, which_, scene))
                                 : term.comparison->at(scene));
    if (!loss_.any()) point.chi2 += point.by_photo.back().chi2;
    if (!within_limits) point.chi2 = std::numeric_limits<double>::infinity();
  }
  if (loss_.any())
    for (const double residual : data_residual(point)) point.chi2 += residual * residual;
  for (const double residual : prior_residual(values)) point.chi2 += residual * residual;
  ++log_.residuals;
  log_.jacobians += with_derivatives;
  return point;
}

void ProfileCost::data_jacobian(const Point& point, std::vector<double>& out) const {
  out.clear();
  out.reserve(static_cast<std::size_t>(data_residuals_) * moved_.size());
  std::vector<double> part;
  for (std::size_t t = 0; t < terms_.size(); ++t) {
    terms_[t].comparison->jacobian(point.by_photo[t], part);
    if (terms_.size() == 1)
      out.swap(part);
    else
      out.insert(out.end(), part.begin(), part.end());
  }
  if (!loss_.any()) return;
  const std::size_t p = moved_.size();
  std::size_t row = 0;
  for (const Comparison::Point& photo : point.by_photo)
    for (const double residual : photo.residual()) {
      const double slope = loss_.slope(residual);
      for (std::size_t j = 0; j < p; ++j) out[row * p + j] *= slope;
      ++row;
    }
}

std::vector<double> ProfileCost::data_residual(const Point& point) const {
  std::vector<double> all;
  for (const Comparison::Point& photo : point.by_photo)
    for (const double residual : photo.residual()) all.push_back(loss_.residual(residual));
  return all;
}

void ProfileCost::evaluate_priors(const std::vector<double>& values, std::vector<double>& residuals,
                                  std::vector<double>* jacobian) const {
  priors_.evaluate(values, residuals, jacobian);
  if (terms_.front().radar == nullptr) return;
  const RadarTerm& term = *terms_.front().radar;
  const std::vector<double> all = all_values(values);
  sim::Scene scene = term.scene;
  term.map.put(all, scene);
  std::vector<double> of_radars, slopes;
  if (jacobian == nullptr) {
    term.radars->evaluate(scene, nullptr, of_radars, nullptr);
  } else {
    const ParameterMap::Motion motion = term.map.motion(all, which_, scene);
    term.radars->evaluate(scene, &motion, of_radars, &slopes);
    for (const double slope : slopes) jacobian->push_back(prior_weight_ * slope);
  }
  for (const double residual : of_radars) residuals.push_back(prior_weight_ * residual);
}

std::vector<double> ProfileCost::prior_residual(const std::vector<double>& values) const {
  std::vector<double> residuals;
  evaluate_priors(values, residuals, nullptr);
  return residuals;
}

std::vector<double> ProfileCost::prior_jacobian(const std::vector<double>& values) const {
  std::vector<double> ignored, by_value;
  evaluate_priors(values, ignored, &by_value);
  return by_value;
}

void ProfileCost::by_coordinates(const std::vector<double>& values, std::vector<double>& jacobian) const {
  const std::size_t p = moved_.size();
  const std::vector<double> at = coordinates(values);
  std::vector<double> slopes(p);
  for (std::size_t j = 0; j < p; ++j) slopes[j] = moved_[j].slope(at[j]);
  for (std::size_t first = 0; first < jacobian.size(); first += p) {
    double* row = &jacobian[first];
    for (const PhaseAnchor& a : anchors_) row[a.wavelength] -= row[a.phase] * a.slope(values[a.wavelength]);
    for (std::size_t j = 0; j < p; ++j) row[j] *= slopes[j];
  }
}

bool ProfileCost::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  const bool with_derivatives = jacobians != nullptr && jacobians[0] != nullptr;
  // Of a trial step Ceres takes the refusal quietly, and its callback then ends the descent. A Jacobian that
  // is refused it calls a failure, and writes so to stderr, whatever the logging type.
  if (log_.exhausted() && !with_derivatives) return false;
  const std::vector<double> here = values(parameters[0]);
  const Point point = at(here, with_derivatives);
  if (!std::isfinite(point.chi2)) return false;

  std::vector<double> all = data_residual(point), prior_residuals, by_value, priors_by_value;
  evaluate_priors(here, prior_residuals, with_derivatives ? &priors_by_value : nullptr);
  all.insert(all.end(), prior_residuals.begin(), prior_residuals.end());
  std::copy(all.begin(), all.end(), residuals);
  if (!with_derivatives) return true;

  data_jacobian(point, by_value);
  by_value.insert(by_value.end(), priors_by_value.begin(), priors_by_value.end());
  by_coordinates(here, by_value);
  std::copy(by_value.begin(), by_value.end(), jacobians[0]);
  return true;
}

Inflation joint_inflation(const ProfileCost& cost, const ProfileCost::Point& point, int unknowns) {
  double squares = 0.0, correlated = 0.0;
  for (std::size_t t = 0; t < cost.terms().size(); ++t) {
    const Comparison& comparison = *cost.terms()[t].comparison;
    const double share = static_cast<double>(comparison.residuals()) / cost.data_residuals();
    const int dof = comparison.residuals() - static_cast<int>(std::lround(share * unknowns));
    const Inflation own = comparison.error_inflation(point.by_photo[t], dof);
    squares += share * own.scale * own.correlated;
    correlated += share * own.correlated;
  }
  return {squares / correlated, correlated};
}

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
