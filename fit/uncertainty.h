// Error bars: from the Jacobian at the answer, and from how the residuals hang together.
#pragma once

#include <vector>

#include "fit/linear_part.h"

namespace vegard::fit {

struct Uncertainty {
  std::vector<double> sigma;  ///< of every coordinate; NaN where the data do not determine it
  std::vector<std::vector<double>> correlation;
  double inflation = 1.0;  ///< already applied to sigma
};

/// How much wider error bars must be than independent, right-sized residuals would have them: the square root
/// of max(1, chi2 / dof) times the number of residuals that go up and down together, which is taken from the
/// residuals' autocorrelation down the rows (to its first zero) times that across channels and to the
/// neighbouring band.
double error_inflation(const Profile& data, const std::vector<std::size_t>& used,
                       const std::vector<double>& residual, int dof);

/// Covariance by singular values of the Jacobian, [residual][coordinate] row-major, columns scaled to unit
/// length; singular values below 1e-7 of the largest count as zero, and every coordinate that leans on such a
/// direction has no error bar.
Uncertainty uncertainty(const std::vector<double>& jacobian, int residuals, int coordinates,
                        double inflation);

}  // namespace vegard::fit
