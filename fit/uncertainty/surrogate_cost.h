// A fast approximation of chi2, from residuals expanded about an answer: it takes microseconds. It replaces
// the model where chi2 is needed very often and need not be exact (surrogate_transition.h).
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <vector>

namespace vegard::fit {

/// With x = answer + L y, L the root of the covariance, residuals are approximated by
///
///   r(x) ≈ r0 + K y + ½ Σ H_kl y_k y_l + ½ w Σ_k≠l T_kkl y_k² y_l + ⅙ Σ T_kkk y_k³,
///
/// a Taylor series with a weight w. K = J L is exact. H and T come from central differences of exact
/// Jacobians kStep standard deviations from the answer to both sides along each column of L: first
/// differences give H, second differences the elements of T that they determine. The differences include the
/// numerical noise of the model's quadrature, which makes T useless for smaller steps (with steps of half a
/// standard deviation a sixth of the proposed moves are accepted; without T three quarters; with kStep five
/// sixths). The sum of squares is a quadratic form in the monomials of y, whose matrix (the Gram matrix of
/// the columns above) is computed once, so that its cost does not depend on the number of residuals.
class SurrogateCost {
 public:
  static constexpr double kStep = 2.5;        ///< in standard deviations
  static constexpr double kMixedShare = 0.5;  ///< w: a T of two coordinates is determined by one of them only
  /// Largest number of coordinates for which monomials of several coordinates are used, since their number
  /// grows with the square.
  static constexpr int kMaxForPairs = 14;

  /// Computes the residuals at `at` and d residual / d coordinate, row-major [residual][coordinate]; returns
  /// false if they cannot be computed.
  using Residuals = std::function<bool(const std::vector<double>& at, std::vector<double>& residuals,
                                       std::vector<double>& jacobian)>;

  /// If the residuals cannot be computed along a column of L, the step is halved repeatedly, and finally the
  /// expansion is linear in this direction. Returns unfinished if `stop` is set.
  SurrogateCost(const Residuals& residuals, const std::vector<double>& answer,
                const std::vector<std::vector<double>>& covariance, const std::atomic<bool>* stop = nullptr);

  /// Returns the expansion's sum of squares less that of the answer; 0 everywhere if the residuals cannot be
  /// computed at the answer.
  double rise(const std::vector<double>& at) const;
  /// Returns |y|², the squared distance from the answer in standard deviations.
  double square(const std::vector<double>& at) const;

 private:
  Eigen::VectorXd whitened(const std::vector<double>& at) const;

  /// The product of up to three components of y with these indices; -1: no factor.
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
