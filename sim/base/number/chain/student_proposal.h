// Samples from Student's distribution around a centre, for independent moves of a Markov chain, which do not
// depend on its position (W. K. Hastings, Biometrika 57 (1970) 97, doi:10.1093/biomet/57.1.97, section 2.5).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vegard::sim {

/// Returns a matrix L with L Lᵀ equal to the covariance [coordinate][coordinate]: the Cholesky factor if
/// there is one, since that transforms like the coordinates under triangular affine transformations. If the
/// covariance is not positive definite, the missing directions get a ten-thousandth of the largest variance,
/// after scaling by the diagonal.
Eigen::MatrixXd root_of_covariance(const std::vector<std::vector<double>>& covariance);

/// Returns `count` independent standard normal numbers of Stream::ensemble, at the indices (i, j, k), (i, j,
/// k + 1) and so on.
Eigen::VectorXd normal_numbers(std::uint64_t seed, std::uint32_t i, std::uint32_t j, std::uint32_t k,
                               std::size_t count);

/// Student's distribution with eight degrees of freedom, which has longer tails than a normal one, around a
/// centre. It is a twentieth wider than the covariance whose root is given.
class StudentProposal {
 public:
  StudentProposal(const std::vector<double>& centre, const Eigen::MatrixXd& root);

  /// Draws a position with at most reach() of the normal_numbers() from (i, j, k) on.
  std::vector<double> draw(std::uint64_t seed, std::uint32_t i, std::uint32_t j, std::uint32_t k) const;
  std::uint32_t reach() const;

  /// Returns the logarithm of the density, 0 at the centre.
  double log_density(const std::vector<double>& at) const;
  /// Returns the square of the Mahalanobis distance from the centre.
  double square(const std::vector<double>& at) const;
  /// Returns centre + L z, L the covariance's root.
  std::vector<double> about_centre(const Eigen::VectorXd& z) const;
  const Eigen::MatrixXd& root() const { return root_; }

 private:
  Eigen::VectorXd centre_;
  Eigen::MatrixXd root_, inverse_root_;
};

}  // namespace vegard::sim
