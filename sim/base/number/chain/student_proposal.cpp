#include "sim/base/number/chain/student_proposal.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "sim/base/number/dense_solvers.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"

namespace vegard::sim {
namespace {

constexpr double kMinShareOfVariance =
    1e-4;                        // of the largest variance, for directions that the covariance lacks
constexpr int kFreedom = 8;      // of Student's distribution
constexpr double kWider = 1.05;  // than the covariance

}  // namespace

Eigen::MatrixXd root_of_covariance(const std::vector<std::vector<double>>& covariance) {
  const auto n = static_cast<Eigen::Index>(covariance.size());
  Eigen::MatrixXd c(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) c(i, j) = covariance[i][j];
  if (c.allFinite()) {
    if (const auto root = cholesky_root(c)) return *root;
  } else {
    c = c.unaryExpr([](double x) { return std::isfinite(x) ? x : 0.0; });
  }
  Eigen::VectorXd length = c.diagonal().cwiseMax(0.0).cwiseSqrt();
  const double longest = n > 0 ? length.maxCoeff() : 0.0;
  for (Eigen::Index i = 0; i < n; ++i)
    if (!(length(i) > 0.0)) length(i) = longest > 0.0 ? longest : 1.0;
  const Eigen::MatrixXd unit = length.cwiseInverse().asDiagonal();
  const SymmetricEigen eigen = symmetric_eigen(unit * c * unit);
  const Eigen::VectorXd value = eigen.values.cwiseMax(
      kMinShareOfVariance * std::max(1.0, n > 0 ? eigen.values(n - 1) : 1.0));
  return length.asDiagonal() * eigen.vectors * value.cwiseSqrt().asDiagonal();
}

Eigen::VectorXd normal_numbers(std::uint64_t seed, std::uint32_t i, std::uint32_t j, std::uint32_t k,
                               std::size_t count) {
  Eigen::VectorXd z(static_cast<Eigen::Index>(count));
  for (std::size_t n = 0; n < count; ++n) {
    const Words w = random_words(seed, Stream::ensemble, i, j, k + static_cast<std::uint32_t>(n));
    z(static_cast<Eigen::Index>(n)) = normal_quantile(fine_uniform(w[0], w[1]));
  }
  return z;
}

StudentProposal::StudentProposal(const std::vector<double>& centre, const Eigen::MatrixXd& root)
    : centre_(Eigen::Map<const Eigen::VectorXd>(centre.data(), static_cast<Eigen::Index>(centre.size()))),
      root_(root),
      inverse_root_(inverse_of(root)) {}

std::uint32_t StudentProposal::reach() const {
  return static_cast<std::uint32_t>(centre_.size()) + static_cast<std::uint32_t>(kFreedom);
}

std::vector<double> StudentProposal::draw(std::uint64_t seed, std::uint32_t i, std::uint32_t j,
                                          std::uint32_t k) const {
  const Eigen::VectorXd z = normal_numbers(seed, i, j, k, reach());
  const double chi2 = z.tail(kFreedom).squaredNorm();
  return about_centre(kWider / std::sqrt(chi2 / kFreedom) * z.head(centre_.size()));
}

double StudentProposal::log_density(const std::vector<double>& at) const {
  const double wide = square(at) / (kWider * kWider);
  return -0.5 * (kFreedom + static_cast<double>(centre_.size())) * std::log1p(wide / kFreedom);
}

double StudentProposal::square(const std::vector<double>& at) const {
  const Eigen::Map<const Eigen::VectorXd> place(at.data(), centre_.size());
  return (inverse_root_ * (place - centre_)).squaredNorm();
}

std::vector<double> StudentProposal::about_centre(const Eigen::VectorXd& z) const {
  const Eigen::VectorXd at = centre_ + root_ * z;
  return {at.data(), at.data() + at.size()};
}

}  // namespace vegard::sim
