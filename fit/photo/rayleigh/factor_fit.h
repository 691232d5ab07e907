// Fits the factor and the air's extinction to stars whose light is known.
//
// Star i has the count rate r_i per rayleigh of its light above the air, and is seen through X_i airmasses:
//   r_i = exp(a - tau X_i); the factor is exp(-a).
// The variance of r_i is sigma_i^2 + (s m_i)^2 with the model's value m_i and a scatter s that all stars
// share (spectra, doubles, twinkling), such that chi^2 equals the degrees of freedom (Paule and Mandel 1982,
// J. Res. NBS 87, 377). The weights depend on the model and not on the measurements, and no logarithm of r_i
// is taken, so that faint stars do not bias the result.
#pragma once

#include <optional>
#include <vector>

namespace vegard::fit {

struct FactorDatum {
  double rate_per_rayleigh = 0.0, sigma = 0.0;
  double airmass = 1.0;
};

struct FactorFit {
  double ln_factor = 0.0, ln_factor_error = 0.0;
  double depth = 0.0,
         depth_error = 0.0;  ///< tau, optical depth of an airmass; the error is 0 if it was given
  double correlation = 0.0;  ///< correlation of ln_factor and depth
  double scatter = 0.0;      ///< s
  int degrees_of_freedom = 0;
  std::vector<char> used;  ///< 0 for outliers of more than 4 standard deviations
};

/// Fits the factor and, unless it is given, the depth. Errors are standard errors of each number; for few
/// stars a 68 % interval is wider by student_68(). Returns nothing if fewer than three stars more than fitted
/// numbers are left.
std::optional<FactorFit> fit_factor(const std::vector<FactorDatum>& stars, std::optional<double> depth);

/// Returns the half-width of the 68.27 % interval of Student's t distribution, which is 1 for a normal
/// distribution; to 1 % from four degrees of freedom up.
double student_68(int degrees_of_freedom);

}  // namespace vegard::fit
