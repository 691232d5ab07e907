#include "fit/uncertainty/band_scatter.h"

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <vector>

namespace vegard::fit {

std::vector<double> factors_by_bands(const BandRows& rows, const std::vector<std::vector<double>>& usual) {
  const auto n = static_cast<Eigen::Index>(rows.coordinates);
  std::map<int, Eigen::VectorXd> score;  // Jᵀ r by band
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t r = 0; r < rows.residual.size(); ++r) {
    if (rows.band[r] < 0) continue;
    const Eigen::Map<const Eigen::VectorXd> row(rows.jacobian.data() + r * rows.coordinates, n);
    information.noalias() += row * row.transpose();
    score.try_emplace(rows.band[r], Eigen::VectorXd::Zero(n)).first->second += row * rows.residual[r];
  }
  const auto bands = static_cast<double>(score.size());
  std::vector<double> factor(rows.coordinates, 1.0);
  if (bands < kFewestBands) return factor;

  // About their mean, which is not 0 where priors or other statistics hold the answer.
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(n);
  for (const auto& [band, s] : score) mean += s / bands;
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(n, n);
  for (const auto& [band, s] : score) scatter.noalias() += (s - mean) * (s - mean).transpose();
  scatter *= bands / (bands - 1.0);

  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k) covariance(i, k) = usual[i][k];
  const Eigen::MatrixXd by_noise = covariance * information * covariance;
  const Eigen::MatrixXd by_bands = covariance * scatter * covariance;
  for (Eigen::Index j = 0; j < n; ++j) {
    const double more = by_bands(j, j) - by_noise(j, j);
    if (more > 0.0 && covariance(j, j) > 0.0) factor[j] = std::sqrt(1.0 + more / covariance(j, j));
  }
  return factor;
}

void widen_by_bands(const std::vector<std::vector<double>>& usual, Uncertainty& u) {
  const std::size_t n = u.by_bands.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) u.covariance[i][k] += (u.by_bands[i] * u.by_bands[k] - 1.0) * usual[i][k];
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isnan(u.sigma[i])) u.sigma[i] = std::sqrt(u.covariance[i][i]);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      const double both = u.sigma[i] * u.sigma[k];
      u.correlation[i][k] = both > 0.0 ? u.covariance[i][k] / both : 0.0;
    }
}

}  // namespace vegard::fit
