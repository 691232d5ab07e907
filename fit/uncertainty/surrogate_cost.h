// A sum of squares that costs microseconds: residuals expanded about an answer, to stand in for the model in
// what asks it very often (surrogate_transition.h) and does not rely on it.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <vector>

namespace vegard::fit {

/// With x = answer + L y, L the root of the covariance, residuals are taken as
///
///   r(x) ≈ r0 + K y + ½ Σ H_kl y_k y_l + ½ w Σ_k≠l T_kkl y_k² y_l + ⅙ Σ T_kkk y_k³,
///
/// Taylor's series with a weight w. K = J L is exact. H and T come from central differences of exact
/// Jacobians kStep standard deviations from the answer along each column of L, two of them for each
/// coordinate: the differences of first order are H, those of second order the T that they determine. They
/// carry the roughness of the model's quadrature: nearer steps make T useless (at half a standard deviation a
/// sixth of the moves by it are accepted; with no T at all three quarters; so, five sixths). The sum of
/// squares is a quadratic form in the monomials of y, of which the matrix (the Gram matrix of the columns
/// above) is worked out once, so that its cost does not depend on how many residuals there are.
class SurrogateCost {
 public:
  static constexpr double kStep = 2.5;        ///< in standard deviations
  static constexpr double kMixedShare = 0.5;  ///< w: a T of two coordinates is only determined by one of them
  /// Coordinates beyond which only monomials of a single coordinate are kept: the others' number grows with
  /// the square.
  static constexpr int kMaxForPairs = 14;

  /// Residuals at a place and d residual / d coordinate, row-major [residual][coordinate]; false where there
  /// are none.
  using Residuals = std::function<bool(const std::vector<double>& at, std::vector<double>& residuals,
                                       std::vector<double>& jacobian)>;

  /// Along a column of L on whose way there are no residuals, steps are halved, and in the end the expansion
  /// is linear. With `stop` raised it comes back unfinished.
  SurrogateCost(const Residuals& residuals, const std::vector<double>& answer,
                const std::vector<std::vector<double>>& covariance, const std::atomic<bool>* stop = nullptr);

  /// The expansion's sum of squares, less that of the answer itself; 0 everywhere if there are no residuals
  /// at the answer.
  double rise(const std::vector<double>& at) const;
  /// |y|²: how far from the answer a place is, in squares of standard deviations.
  double square(const std::vector<double>& at) const;

 private:
  Eigen::VectorXd whitened(const std::vector<double>& at) const;

  /// y to the powers that the (up to three) indices say; -1: none.
  struct Monomial {
    int k = -1, l = -1, m = -1;
  };

  Eigen::VectorXd answer_;
  Eigen::MatrixXd inverse_root_;
  std::vector<Monomial> monomials_;
  Eigen::MatrixXd gram_;
  mutable Eigen::VectorXd terms_;
};

}  // namespace vegard::fit
