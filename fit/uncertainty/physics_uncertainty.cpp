#include "fit/uncertainty/physics_uncertainty.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "sim/light/tables/emission_tables.h"

namespace vegard::fit {
namespace {

/// The modes to be considered.
std::vector<std::size_t> considered_modes(const ProfileCost& cost) {
  const sim::Scene& scene = cost.terms().front().scene;
  if (scene.emission.uncertainty == sim::TablesUncertainty::none) return {};
  const auto by_tables = [](const auto& each) { return sim::is_of_electrons(each.profile); };
  if (std::none_of(scene.sheets.begin(), scene.sheets.end(), by_tables) &&
      std::none_of(scene.footprints.begin(), scene.footprints.end(), by_tables))
    return {};
  std::vector<std::size_t> modes;
  for (int k = 0; k < sim::emission_tables(scene).modes().count(); ++k) {
    const auto is_this = [&](const FreeNumber& number) {
      return number.has_role(sim::ParameterRole::light_mode) && number.id.component == k;
    };
    if (std::none_of(cost.moved().begin(), cost.moved().end(), is_this))
      modes.push_back(static_cast<std::size_t>(k));
  }
  return modes;
}

/// Half the gradient of the data's chi2 by the coordinates.
Eigen::VectorXd half_gradient(const ProfileCost& cost, const std::vector<double>& values) {
  const ProfileCost::Point point = cost.at(values, true);
  std::vector<double> jacobian;
  cost.data_jacobian(point, jacobian);
  cost.by_coordinates(values, jacobian);
  const std::vector<double> residual = cost.data_residual(point);
  const auto coordinates = static_cast<Eigen::Index>(values.size());
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(coordinates);
  for (std::size_t r = 0; r < residual.size(); ++r)
    for (Eigen::Index j = 0; j < coordinates; ++j)
      gradient(j) += residual[r] * jacobian[r * values.size() + static_cast<std::size_t>(j)];
  return gradient;
}

}  // namespace

void add_physics(const ProfileCost& cost, const std::vector<double>& values, Uncertainty& u) {
  const std::vector<std::size_t> modes = considered_modes(cost);
  if (modes.empty()) return;
  const std::size_t n = values.size();
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::MatrixXd covariance(size, size);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < n; ++k)
      covariance(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)) = u.covariance[j][k];
  const Eigen::MatrixXd before_inflation = covariance / (u.inflation * u.inflation);
  EvaluationLog aside;
  const auto gradient_of = [&](const std::vector<CostTerm>& terms) {
    return half_gradient(ProfileCost(cost.moved(), terms, aside), values);
  };
  const Eigen::VectorXd usual = gradient_of(cost.terms());
  std::vector<bool> is_unknown(n, false);
  for (const std::size_t mode : modes) {
    std::vector<CostTerm> terms = cost.terms();
    for (CostTerm& term : terms) {
      std::vector<double>& coefficients = term.scene.emission.modes;
      coefficients.resize(std::max(coefficients.size(), mode + 1), 0.0);
      coefficients[mode] += 1.0;
    }
    Eigen::VectorXd shift = before_inflation * (gradient_of(terms) - usual);
    for (std::size_t j = 0; j < n; ++j) {
      double& of_number = shift(static_cast<Eigen::Index>(j));
      is_unknown[j] = is_unknown[j] || !std::isfinite(of_number);
      if (!std::isfinite(of_number)) of_number = 0.0;
    }
    covariance += shift * shift.transpose();
  }
  for (std::size_t j = 0; j < n; ++j) {
    double& sigma = u.sigma[j];
    if (is_unknown[j]) sigma = std::numeric_limits<double>::quiet_NaN();
    if (!std::isnan(sigma))
      sigma = std::sqrt(covariance(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(j)));
  }
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < n; ++k) {
      u.covariance[j][k] = covariance(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k));
      const double both = u.sigma[j] * u.sigma[k];
      u.correlation[j][k] = both > 0.0 ? u.covariance[j][k] / both : 0.0;
    }
}

}  // namespace vegard::fit
