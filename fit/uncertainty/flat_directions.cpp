#include "fit/uncertainty/flat_directions.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/number/dense_solvers.h"

namespace vegard::fit {
namespace {

constexpr double kProbe = 3.0;            // standard deviations
constexpr double kMinRise = 0.25;         // of the parabola's
constexpr double kFarthest = 8.0;         // times as far out
constexpr double kOwes = 0.5;             // of a variance
constexpr double kProbed = 0.1;           // of a normalised axis' square
constexpr double kPartOfDirection = 0.5;  // of a standard deviation

}  // namespace

void drop_flat_directions(const std::function<double(const std::vector<double>& step)>& rise,
                          const std::vector<bool>& bounded, Uncertainty& u) {
  const auto n = static_cast<Eigen::Index>(u.sigma.size());
  Eigen::VectorXd sigma(n);
  for (Eigen::Index i = 0; i < n; ++i) sigma(i) = std::sqrt(std::max(0.0, u.covariance[i][i]));
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k)
      if (sigma(i) > 0.0 && sigma(k) > 0.0) correlation(i, k) = u.covariance[i][k] / (sigma(i) * sigma(k));
  const sim::SymmetricEigen axes = sim::symmetric_eigen(correlation);

  std::vector<double> variance(n);
  for (Eigen::Index i = 0; i < n; ++i) variance[i] = u.covariance[i][i];
  for (Eigen::Index a = 0; a < n; ++a) {
    if (axes.values(a) <= 0.0) continue;
    const Eigen::VectorXd axis =
        sigma.cwiseProduct(axes.vectors.col(a)) * std::sqrt(axes.values(a));
    double probed = 0.0;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!bounded[i]) probed += axes.vectors(i, a) * axes.vectors(i, a);
    if (probed < kProbed) continue;
    const auto is_flat = [&](double side) {
      std::vector<double> step(n);
      for (Eigen::Index i = 0; i < n; ++i) step[i] = side * axis(i);
      const double rose = rise(step);
      return std::isfinite(rose) && rose < kMinRise * kProbe * kProbe;
    };
    double longer = 1.0;
    for (const double side : {-kProbe, kProbe})
      while (longer <= kFarthest && is_flat(longer * side)) longer *= 2.0;
    if (longer == 1.0) continue;
    if (longer <= kFarthest) {
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index k = 0; k < n; ++k)
          u.covariance[i][k] += (longer * longer - 1.0) * axis(i) * axis(k);
      continue;
    }
    std::vector<double> direction(n, 0.0);
    double largest = 0.0;
    for (Eigen::Index i = 0; i < n; ++i)
      if (sigma(i) > 0.0 && std::abs(axis(i)) > kPartOfDirection * sigma(i)) {
        direction[i] = axis(i);
        largest = std::max(largest, std::abs(axis(i)));
      }
    for (double& part : direction) part /= largest;
    u.undetermined.push_back(direction);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index k = 0; k < n; ++k) u.covariance[i][k] -= axis(i) * axis(k);
      if (axis(i) * axis(i) > kOwes * variance[i]) u.sigma[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  for (Eigen::Index i = 0; i < n; ++i)
    if (!std::isnan(u.sigma[i])) u.sigma[i] = std::sqrt(std::max(0.0, u.covariance[i][i]));
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k) {
      const bool has_both = u.sigma[i] > 0.0 && u.sigma[k] > 0.0;
      u.correlation[i][k] = i == k && has_both ? 1.0
                            : has_both         ? u.covariance[i][k] / (u.sigma[i] * u.sigma[k])
                                               : 0.0;
    }
}

}  // namespace vegard::fit
