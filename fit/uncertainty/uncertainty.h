// Error bars: from the Jacobian at the answer.
#pragma once

#include <vector>

namespace vegard::fit {

struct Uncertainty {
  std::vector<double> sigma;  ///< of every coordinate; NaN where the data do not determine it
  std::vector<std::vector<double>> correlation;  ///< rows of coordinates without an error bar hold zeros
  /// Of the coordinates, limits included; for combinations of coordinates (see derived.h).
  std::vector<std::vector<double>> covariance;
  /// Directions in which the data say nothing, each with a largest component of 1.
  std::vector<std::vector<double>> undetermined;
  double inflation = 1.0;  ///< already applied to sigma
};

/// What is known of the coordinates beside the data.
struct PriorKnowledge {
  std::vector<double> information;  ///< of priors, row-major [coordinate][coordinate]
  /// Variance of a coordinate inside its limits, every value there being alike likely; infinity without.
  std::vector<double> limit_variance;
  std::vector<bool> has_prior;  ///< coordinates that a prior bounds, whatever the data say
};

/// Nothing known of so many coordinates.
PriorKnowledge no_prior_knowledge(std::size_t coordinates);

/// Covariance from the Jacobians of independent samplings of one scene, [residual][coordinate] row-major
/// each. The data's information is the mean of the products of *different* samplings, so that a Jacobian's
/// own Monte-Carlo noise, whose square would pass for information, cancels; a direction whose information is
/// within two standard errors of nothing, by the spread of the single products, or below 1e-12 of the
/// largest, has none. To it the priors' information is added, and that of the limits.
///
/// Undetermined are directions of which the data leave more than a quarter of the variance that the limits
/// allow. A coordinate without a prior to which that has happened has no error bar.
Uncertainty uncertainty(const std::vector<std::vector<double>>& jacobians, int residuals, int coordinates,
                        const PriorKnowledge& prior, double inflation);

}  // namespace vegard::fit
