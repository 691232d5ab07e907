#include "fit/uncertainty/physics_uncertainty.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/light/tables/emission_tables.h"

namespace vegard::fit {
namespace {

/// The number of modes to be considered.
int considered_modes(const ProfileCost& cost) {
  const sim::Scene& scene = cost.terms().front().scene;
  if (scene.emission.uncertainty == sim::TablesUncertainty::none) return 0;
  const auto by_tables = [](const auto& each) { return sim::is_of_electrons(each.profile); };
  if (std::none_of(scene.sheets.begin(), scene.sheets.end(), by_tables) &&
      std::none_of(scene.footprints.begin(), scene.footprints.end(), by_tables))
    return 0;
  for (const FreeNumber& number : cost.moved())
    if (number.has_role(sim::ParameterRole::light_mode)) return 0;
  return sim::emission_tables(scene).modes().count();
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
  const int modes = considered_modes(cost);
  if (modes == 0) return;
  const auto n = static_cast<Eigen::Index>(values.size());
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index k = 0; k < n; ++k)
      covariance(j, k) = u.covariance[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)];
  const Eigen::MatrixXd of_data = covariance / (u.inflation * u.inflation);
  const Eigen::VectorXd usual = half_gradient(cost, values);
  for (int k = 0; k < modes; ++k) {
    std::vector<CostTerm> terms = cost.terms();
    for (CostTerm& term : terms) {
      std::vector<double>& coefficients = term.scene.emission.modes;
      coefficients.resize(static_cast<std::size_t>(modes), 0.0);
      coefficients[static_cast<std::size_t>(k)] += 1.0;
    }
    EvaluationLog aside;
    const ProfileCost changed(cost.moved(), terms, aside, {{}, {}, {}, 1.0, cost.anchors()});
    const Eigen::VectorXd shift = of_data * (half_gradient(changed, values) - usual);
    if (shift.allFinite()) covariance += shift * shift.transpose();
  }
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index k = 0; k < n; ++k)
      u.covariance[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)] = covariance(j, k);
    double& sigma = u.sigma[static_cast<std::size_t>(j)];
    if (!std::isnan(sigma)) sigma = std::sqrt(covariance(j, j));
  }
}

}  // namespace vegard::fit
