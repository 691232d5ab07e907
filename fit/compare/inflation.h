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

/// chi2 / dof of `residuals` values of which so many go together, with one standard error of it added, for
/// it is a mean over residuals / together independent squares: sqrt(2 together / residuals) of itself. Below
/// 1 where sigma, of which the model error is an estimate, is more than what was missed; not below 0.01, for
/// a made picture may be met to its rounding.
double residual_scale(double chi2, int dof, double residuals, double together);

/// How much wider error bars must be than independent residuals of size 1 would have them.
struct Inflation {
  double scale = 1.0;     ///< residual_scale(): of the residuals' squares
  double together = 1.0;  ///< correlated_residuals()
  /// Of error bars: the square root of both. Below 1 where sigma was taken too large.
  double factor() const;
};

Inflation error_inflation(const Profile& data, const std::vector<std::size_t>& used,
                          const std::vector<double>& residual, int dof);

}  // namespace vegard::fit
