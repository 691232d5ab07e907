// Error bars of a fit from the Jacobian at its answer.
#pragma once

#include <vector>

namespace vegard::fit {

struct Uncertainty {
  std::vector<double> sigma;  ///< of every coordinate; NaN where the data do not determine it
  std::vector<std::vector<double>> correlation;  ///< zeros for coordinates without an error bar
  /// Covariance of the coordinates, with the information of their limits; for derived numbers
  /// (delta_method.h).
  std::vector<std::vector<double>> covariance;
  /// Directions that the data do not determine, each with a largest component of 1.
  std::vector<std::vector<double>> undetermined;
  double inflation = 1.0;  ///< already applied to sigma
};

/// Knowledge of the coordinates from other sources than the data.
struct PriorKnowledge {
  std::vector<double> information;  ///< information matrix of priors, row-major [coordinate][coordinate]
  /// Variance of each coordinate for a uniform distribution between its limits; infinity without limits.
  std::vector<double> limit_variance;
  std::vector<bool> has_prior;  ///< [coordinate] a prior bounds it, whatever the data are
};

/// Returns the absence of prior knowledge for this number of coordinates.
PriorKnowledge no_prior_knowledge(std::size_t coordinates);

/// Computes the covariance from the Jacobians of independent samplings of one scene, each row-major
/// [residual][coordinate]. The data's information is the mean of the products of *different* samplings, so
/// that a Jacobian's Monte-Carlo noise, whose square would look like information, cancels. The information in
/// a direction is set to 0 if it is within two standard errors of 0, by the scatter of the products, or below
/// 1e-12 of the largest. Then the information of priors and of limits is added.
///
/// A direction is undetermined if its variance is more than a quarter of the variance that the limits allow.
/// A coordinate that is affected by an undetermined direction and has no prior has no error bar.
Uncertainty uncertainty(const std::vector<std::vector<double>>& jacobians, int residuals, int coordinates,
                        const PriorKnowledge& prior, double inflation);

}  // namespace vegard::fit
