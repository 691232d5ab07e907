// Places drawn from Student's distribution about a centre, for moves of a Markov chain that do not depend on
// where it is (W. K. Hastings, Biometrika 57 (1970) 97, doi:10.1093/biomet/57.1.97, section 2.5).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vegard::sim {

/// A matrix L with L Lᵀ the covariance [coordinate][coordinate]. A Cholesky factor wherever there is one: it
/// goes along with an affine change of the coordinates that is triangular itself. Where the covariance is not
/// positive definite, the directions that it lacks get a ten-thousandth of the largest variance in terms of
/// its diagonal.
Eigen::MatrixXd root_of_covariance(const std::vector<std::vector<double>>& covariance);

/// `count` independent standard normal numbers of Stream::ensemble: at the indices (i, j, k), (i, j, k + 1)
/// and so on.
Eigen::VectorXd normal_numbers(std::uint64_t seed, std::uint32_t i, std::uint32_t j, std::uint32_t k,
                               std::size_t count);

/// Student's distribution of eight degrees of freedom, which has longer tails than a normal one, about a
/// centre; a twentieth wider than the covariance of which the root is given.
class StudentProposal {
 public:
  StudentProposal(const std::vector<double>& centre, const Eigen::MatrixXd& root);

  /// A place, from the normal_numbers() at (i, j, k) and on. No more than reach() of them are used.
  std::vector<double> draw(std::uint64_t seed, std::uint32_t i, std::uint32_t j, std::uint32_t k) const;
  std::uint32_t reach() const;

  /// Logarithm of its density, 0 at the centre.
  double log_density(const std::vector<double>& at) const;
  /// The covariance's own square of a distance from the centre: Mahalanobis'.
  double square(const std::vector<double>& at) const;
  /// centre + L z, L the covariance's root.
  std::vector<double> about_centre(const Eigen::VectorXd& z) const;
  const Eigen::MatrixXd& root() const { return root_; }

 private:
  Eigen::VectorXd centre_;
  Eigen::MatrixXd root_, inverse_root_;
};

}  // namespace vegard::sim
