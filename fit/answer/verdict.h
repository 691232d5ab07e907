// The verdict on a fit: good, doubtful, failed or interrupted, with its reasons.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// The evidence for the verdict, in addition to the numbers already in the result.
struct Evidence {
  bool converged = false;
  bool stopped = false;  ///< by the user
  bool out_of_evaluations = false;
  bool aurora_in_view = true;  ///< the model has any light in the region
  double chi2_without_aurora = 0.0;
  double unknowns = 0.0;     ///< number that the data determine if there are priors; 0: every parameter
  bool second_mode = false;  ///< another minimum explains the data almost as well
  std::string second_mode_text;
  std::vector<double> second_mode_values;  ///< of the free numbers
  std::string transfer_curve_words;  ///< the transfer curve that was found, in words; empty: it was known
  std::vector<std::string> against_transfer_curve;  ///< reasons to doubt the curve
};

/// Sets verdict, verdict_line, reasons and checks.
///
/// A fit failed if it did not converge, or if no light of the model falls into the region. It is doubtful for
/// any of these reasons: chi2 is not below that of the start; the gradient does not vanish at the end
/// (fit/search/descent.h); chi2 per degree of freedom is above 3; the residuals are correlated so
/// strongly that the effective sample size is below ten per parameter; a parameter is at a limit, has no
/// error bar, or has one and yet did not move from its start (unless no parameter moved and the gradient
/// vanishes: then the start was the answer); chi2 is hardly below that of a sky without aurora; the rms
/// residual is above a tenth of the peak; there is a second mode; the data do not constrain an unknown
/// transfer curve. A sheet's length, phase and position along itself are exempt where its distance has an
/// error bar. After the verdict's own reasons come notes that do not change it: chi2 per degree of freedom
/// below 0.3, and unusual_sheets().
void assess_fit(const Evidence& evidence, FitResult& result);

/// Sets trust and its reason of every derived number, after the verdict on the whole fit. A number without an
/// error bar is unconstrained; one with a large error bar is doubtful or unconstrained by the scale of its
/// kind; one that depends on a parameter at its limit is doubtful at best. All numbers are doubtful at best
/// if the model does not explain the picture as a whole or the search did not converge. Correlated residuals
/// count against lateral offsets of a sheet; they count against other numbers only if the effective sample
/// size is below five per parameter. A second mode counts only against numbers that it changes. An
/// unconstrained parameter (a sheet's length, when no end is in view) affects only the numbers that depend on
/// it. The error that counts is DerivedNumber::error(). The verdict line of a doubtful fit gets a sentence
/// that names the numbers which are good nevertheless.
void assess_quantities(FitResult& result);

}  // namespace vegard::fit
