#include "fit/uncertainty/physics_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fit/uncertainty/sampled_uncertainty.h"
#include "sim/base/number/dense_solvers.h"
#include "sim/light/tables/emission_tables.h"

namespace vegard::fit {
namespace {

constexpr double kModeStep = 0.1;       // standard deviations
constexpr double kGoesWithShift = 0.5;  // of a standard deviation

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The modes to be considered.
std::vector<int> considered_modes(const ProfileCost& cost) {
  const sim::Scene& scene = cost.terms().front().scene;
  if (scene.emission.uncertainty == sim::TablesUncertainty::none) return {};
  const auto by_tables = [](const auto& each) { return sim::is_of_electrons(each.profile); };
  if (std::none_of(scene.sheets.begin(), scene.sheets.end(), by_tables) &&
      std::none_of(scene.footprints.begin(), scene.footprints.end(), by_tables))
    return {};
  std::vector<int> modes;
  for (int k = 0; k < sim::emission_tables(scene).modes().count(); ++k) {
    const auto is_this = [&](const FreeNumber& number) {
      return number.has_role(sim::ParameterRole::light_mode) && number.id.component == k;
    };
    if (std::none_of(cost.moved().begin(), cost.moved().end(), is_this)) modes.push_back(k);
  }
  return modes;
}

RowMajorMatrix matrix_of(const std::vector<double>& rows, std::size_t columns) {
  const auto n = static_cast<Eigen::Index>(columns);
  const Eigen::Index count = n > 0 ? static_cast<Eigen::Index>(rows.size()) / n : 0;
  return Eigen::Map<const RowMajorMatrix>(rows.data(), count, n);
}

/// The data's part of a cost at an answer.
struct DataAtAnswer {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  std::vector<std::vector<double>> linear_part;

  DataAtAnswer(const ProfileCost& cost, const std::vector<double>& values) {
    const ProfileCost::Point point = cost.at(values, true);
    std::vector<double> by_coordinate;
    cost.data_jacobian(point, by_coordinate);
    cost.by_coordinates(values, by_coordinate);
    jacobian = matrix_of(by_coordinate, values.size());
    const std::vector<double> all = cost.data_residual(point);
    residual = Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
    for (const Comparison::Point& photo : point.by_photo) linear_part.push_back(photo.solution.coefficients);
  }
  Eigen::VectorXd half_gradient() const { return jacobian.transpose() * residual; }
};

/// Of a number's own prior, or that of a free-form profile's smoothness.
bool has_prior_of_its_own(const FreeNumber& number) {
  return (number.prior && number.prior->law != sim::PriorLaw::uniform) ||
         number.has_role(sim::ParameterRole::profile_coefficient);
}

/// Of each coordinate; infinity where it has a prior.
std::vector<double> limit_variances(const std::vector<FreeNumber>& numbers,
                                    const std::vector<double>& values) {
  std::vector<double> variances;
  for (std::size_t j = 0; j < values.size(); ++j)
    variances.push_back(has_prior_of_its_own(numbers[j])
                            ? std::numeric_limits<double>::infinity()
                            : limit_variance(numbers[j], numbers[j].slope(numbers[j].coordinate(values[j]))));
  return variances;
}

/// What `cost`'s priors and the limits say. `plain` is the same cost without anchors.
Eigen::MatrixXd prior_information(const ProfileCost& cost, const ProfileCost& plain,
                                  const std::vector<double>& values) {
  std::vector<double> rows = cost.prior_jacobian(values);
  plain.by_coordinates(values, rows);
  const Eigen::MatrixXd by_coordinate = matrix_of(rows, values.size()) / cost.prior_weight();
  Eigen::MatrixXd information = by_coordinate.transpose() * by_coordinate;
  for (std::size_t j = 0; j < values.size(); ++j) {
    const FreeNumber& number = cost.moved()[j];
    const auto at = static_cast<Eigen::Index>(j);
    information(at, at) += 1.0 / limit_variance(number, number.slope(number.coordinate(values[j])));
  }
  return information;
}

Eigen::MatrixXd matrix_of(const std::vector<std::vector<double>>& rows) {
  const auto size = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd matrix(size, size);
  for (Eigen::Index j = 0; j < size; ++j)
    for (Eigen::Index k = 0; k < size; ++k)
      matrix(j, k) = rows[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)];
  return matrix;
}

/// What goes with a shift of coordinate j, as drop_flat_directions() has its directions.
std::vector<double> direction_with(const Eigen::MatrixXd& covariance, Eigen::Index j) {
  std::vector<double> direction(static_cast<std::size_t>(covariance.rows()), 0.0);
  double largest = 0.0;
  for (Eigen::Index k = 0; k < covariance.rows(); ++k) {
    const double both = std::sqrt(covariance(j, j) * covariance(k, k));
    if (k != j && !(std::abs(covariance(j, k)) > kGoesWithShift * both)) continue;
    direction[static_cast<std::size_t>(k)] = covariance(j, k);
    largest = std::max(largest, std::abs(covariance(j, k)));
  }
  for (double& part : direction) part /= largest;
  return direction;
}

}  // namespace

ModeEffects mode_effects(const ProfileCost& cost, const std::vector<double>& values) {
  ModeEffects effects;
  effects.modes = considered_modes(cost);
  if (effects.modes.empty()) return effects;
  EvaluationLog aside;
  const ProfileCost plain(cost.moved(), cost.terms(), aside);
  DataAtAnswer usual(plain, values);
  const auto modes = static_cast<Eigen::Index>(effects.modes.size());
  effects.by_mode.resize(usual.residual.size(), modes);
  effects.gradient_change.resize(usual.jacobian.cols(), modes);
  for (Eigen::Index k = 0; k < modes; ++k) {
    std::vector<CostTerm> terms = cost.terms();
    for (CostTerm& term : terms)
      sim::add_to_mode(term.scene, effects.modes[static_cast<std::size_t>(k)], kModeStep);
    const DataAtAnswer changed(ProfileCost(cost.moved(), terms, aside), values);
    effects.by_mode.col(k) = (changed.residual - usual.residual) / kModeStep;
    effects.gradient_change.col(k) = (changed.half_gradient() - usual.half_gradient()) / kModeStep;
    effects.linear_part.push_back(changed.linear_part);
    for (std::size_t p = 0; p < usual.linear_part.size(); ++p)
      for (std::size_t c = 0; c < usual.linear_part[p].size(); ++c) {
        double& slope = effects.linear_part.back()[p][c];
        slope = (slope - usual.linear_part[p][c]) / kModeStep;
      }
  }
  effects.prior = prior_information(cost, plain, values);
  effects.limit_variance = limit_variances(cost.moved(), values);
  effects.residual = std::move(usual.residual);
  effects.jacobian = std::move(usual.jacobian);
  return effects;
}

void add_physics(const ModeEffects& effects, Uncertainty& u) {
  if (effects.modes.empty()) return;
  const std::size_t n = u.sigma.size();
  const Eigen::MatrixXd usual = matrix_of(u.covariance);
  Eigen::MatrixXd covariance = usual;
  std::vector<bool> is_unknown(n, false);
  for (std::size_t m = 0; m < effects.modes.size(); ++m) {
    Eigen::VectorXd shift =
        -(usual * effects.gradient_change.col(static_cast<Eigen::Index>(m))) / (u.inflation * u.inflation);
    for (std::size_t j = 0; j < n; ++j) {
      double& of_number = shift(static_cast<Eigen::Index>(j));
      is_unknown[j] = is_unknown[j] || !std::isfinite(of_number);
      if (!std::isfinite(of_number)) of_number = 0.0;
    }
    covariance += shift * shift.transpose();
    u.modes.push_back(
        {effects.modes[m], std::vector<double>(shift.data(), shift.data() + n), effects.linear_part[m]});
  }
  for (std::size_t j = 0; j < n; ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    double& sigma = u.sigma[j];
    const double open = kLeftOpen * effects.limit_variance[j];
    const bool is_opened = !std::isnan(sigma) && usual(at, at) < open && covariance(at, at) >= open;
    if (is_opened) u.undetermined.push_back(direction_with(covariance, at));
    if (is_unknown[j] || is_opened) sigma = std::numeric_limits<double>::quiet_NaN();
    if (!std::isnan(sigma)) sigma = std::sqrt(covariance(at, at));
  }
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < n; ++k) {
      u.covariance[j][k] = covariance(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k));
      const double both = u.sigma[j] * u.sigma[k];
      u.correlation[j][k] = both > 0.0 ? u.covariance[j][k] / both : 0.0;
    }
}

ModeInformation mode_information(const ModeEffects& effects, double inflation) {
  ModeInformation told;
  if (effects.modes.empty() || !effects.residual.allFinite() || !effects.by_mode.allFinite() ||
      !effects.jacobian.allFinite())
    return told;
  const double believed = 1.0 / (inflation * inflation);
  const Eigen::MatrixXd of_answer =
      believed * effects.jacobian.transpose() * effects.jacobian + effects.prior;
  const Eigen::MatrixXd of_both = believed * effects.jacobian.transpose() * effects.by_mode;
  // Scaled to a unit diagonal, so that units do not matter.
  const Eigen::MatrixXd scale = of_answer.diagonal()
                                    .unaryExpr([](double x) { return x > 0.0 ? 1.0 / std::sqrt(x) : 1.0; })
                                    .asDiagonal();
  const Eigen::MatrixXd scaled = scale * of_both;
  told.modes = effects.modes;
  const Eigen::MatrixXd left =
      believed * effects.by_mode.transpose() * effects.by_mode -
      scaled.transpose() * sim::solve_symmetric(Eigen::MatrixXd(scale * of_answer * scale), scaled);
  const Eigen::VectorXd towards = -believed * (effects.by_mode.transpose() * effects.residual);
  for (Eigen::Index i = 0; i < left.rows(); ++i)
    for (Eigen::Index k = 0; k < left.cols(); ++k)
      told.information.push_back(0.5 * (left(i, k) + left(k, i)));  // symmetric but for rounding
  told.towards.assign(towards.data(), towards.data() + towards.size());
  return told;
}

LearntModes learnt_modes(const ModeInformation& told) {
  LearntModes learnt;
  const auto count = static_cast<Eigen::Index>(told.modes.size());
  if (count == 0) return learnt;
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(count, count);
  learnt.modes = told.modes;
  const Eigen::Map<const RowMajorMatrix> information(told.information.data(), count, count);
  learnt.covariance = sim::solve_symmetric(Eigen::MatrixXd(information + unit), unit);
  learnt.value = learnt.covariance * Eigen::Map<const Eigen::VectorXd>(told.towards.data(), count);
  return learnt;
}

}  // namespace vegard::fit
