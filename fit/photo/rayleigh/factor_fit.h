// The factor and the air's extinction from stars whose light is known.
//
// Star i of the count rate r_i for each rayleigh that its light is worth, seen through X_i airmasses:
//   r_i = exp(a - tau X_i), the factor is exp(-a).
// Its variance is sigma_i^2 + (s m_i)^2, m_i what the model has for it and s a scatter that all share
// (spectra, doubles, twinkling), found so that chi^2 is its degrees of freedom (Paule and Mandel 1982, J.
// Res. NBS 87, 377). Weights go by the model and not by what was measured, and r_i is not put into a
// logarithm, so that faint stars do not bend the answer.
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
         depth_error = 0.0;  ///< tau, optical depth of an airmass; the error is 0 where it was given
  double correlation = 0.0;  ///< of the two
  double scatter = 0.0;      ///< s
  int degrees_of_freedom = 0;
  std::vector<char> used;  ///< 0: farther off than 4 standard deviations
};

/// `depth`: held, else found. Errors are those of one number by itself; of few stars a 68 % interval is wider
/// by student_68(). None where fewer than three stars more than numbers are left.
std::optional<FactorFit> fit_factor(const std::vector<FactorDatum>& stars, std::optional<double> depth);

/// What Student's t has in place of 1 for 68.27 %, to 1 % from four degrees of freedom up.
double student_68(int degrees_of_freedom);

}  // namespace vegard::fit
