// Whether to believe a fit.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// What the verdict is made from, beside the numbers already in the result.
struct Evidence {
  bool converged = false;
  bool stopped = false;  ///< by the user
  bool out_of_evaluations = false;
  bool aurora_in_view = true;  ///< the model has any light in the region
  double chi2_without_aurora = 0.0;
  double unknowns = 0.0;     ///< that the data determine, where priors do the rest; 0: every parameter
  bool second_mode = false;  ///< another valley explains the data almost as well
  std::string second_mode_text;
  std::vector<double> second_mode_values;  ///< of the free numbers
  std::string curve_words;  ///< what was found of an unknown transfer curve; empty: it is known
  std::vector<std::string> against_curve;  ///< what speaks against that
};

/// Sets verdict, verdict_line, reasons and checks. Failed: not converged, or no light of the model in the
/// region. Doubtful: chi2 no lower than at the start; an end that is not level
/// (fit/search/gradient_cosine.h); chi2 per degree of freedom above 3; residuals that hang together so much
/// that fewer than ten independent values are left per parameter; a parameter at a limit, without an error
/// bar, or with one and yet where it started (unless all are, and the end is level: then the start was the
/// answer). A sheet's length, phase and place along itself are held without blame where its distance has an
/// error bar; no clear gain over a sky without aurora; an rms residual above a tenth of the peak; a second
/// mode; an unknown transfer curve that the data leave open. After the verdict's own reasons come notes that
/// leave it as it is: chi2 per degree of freedom below 0.3, and unusual_sheets().
void assess_fit(const Evidence& evidence, FitResult& result);

/// Sets trust and its reason of every derived number, after the verdict of the whole has been found. A number
/// without an error bar is not told; one with a large one is doubtful or not told by its kind's scale; one
/// that leans on a parameter at its limit is doubtful at best; and all are doubtful at best where the picture
/// as a whole is not explained, or the search has not ended well. Residuals that form patterns speak against
/// a sheet's course; against other numbers only where fewer than five independent values are left per
/// parameter. Another answer that explains the data as well speaks only against numbers that
/// it changes. A parameter that the picture does not tell (a sheet's length, when no end is in view) spoils
/// only the numbers that depend on it. The error that counts is DerivedNumber::error(). The verdict line of a
/// doubtful fit gets a sentence on what is good all the same.
void assess_quantities(FitResult& result);

}  // namespace vegard::fit
