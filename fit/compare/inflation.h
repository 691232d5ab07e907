// Error inflation: the size and the correlation of the residuals, and the factor on error bars that follows.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/measure/profile.h"

namespace vegard::fit {

/// The number of correlated residuals that carry the information of one independent residual: the largest
/// partial sum of their autocorrelation down the rows (to a quarter of the rows), times that across the bands
/// (to a quarter of the bands, at least the neighbouring one), times that across channels. At least 1.
double correlated_residuals(const Profile& data, const std::vector<std::size_t>& used,
                            const std::vector<double>& residual);

/// Returns chi2 / dof plus one standard error of it. `residuals` is the number of residuals, `correlated` the
/// number of correlated ones per independent one: the mean over residuals / correlated independent squares
/// has a relative standard error of sqrt(2 correlated / residuals). The result is below 1 where sigma, which
/// includes an estimated model error, is too large; it is at least 0.01, for a synthetic picture may be
/// fitted to within its rounding.
double residual_scale(double chi2, int dof, double residuals, double correlated);

/// The widening of error bars for residuals that are correlated or not of size 1.
struct Inflation {
  double scale = 1.0;       ///< residual_scale(), for the residuals' squares
  double correlated = 1.0;  ///< correlated_residuals()
  /// Factor on error bars: the square root of scale * correlated. Below 1 where sigma was too large.
  double factor() const;
};

Inflation error_inflation(const Profile& data, const std::vector<std::size_t>& used,
                          const std::vector<double>& residual, int dof);

}  // namespace vegard::fit
