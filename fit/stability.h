// The stability of an answer under other choices: the part of the region that is compared, the number of
// bands, the terms of the sky, the air, the transfer curve, the model error.
//
// The fit is repeated from its answer with one choice changed at a time. What a number moves by beyond what
// chance would do is its systematic error. Chance: a fit of other data that overlap has the variance of the
// difference |sigma² - sigma'²| (R. Barlow, "Systematic errors: facts and fictions", Advanced Statistical
// Techniques in Particle Physics, Durham 2002, arXiv:hep-ex/0207026, section 4.2). A sky, an air or a curve
// that makes chi2 per degree of freedom more than twice as large is refuted by the picture itself, and its
// shifts do not count.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"
#include "fit/search/fit_options.h"

namespace vegard::fit {

/// One choice made otherwise.
struct Variation {
  std::string choice;        ///< "region", "bands", "sky", "air", "curve", "model error"
  std::string name;          ///< "without its left third"
  sim::Scene scene;          ///< that starts at the answer and searches nothing else
  double curve_power = 1.0;  ///< to which the photograph's linear light is raised
};

/// Those that `best`, a FitResult's, leaves room for: no air where there is no aurora or its haze is free, no
/// curve for photographs that were linear in their files or whose curve was found, no region of several
/// photographs, across a loop or about the Sun's limb.
std::vector<Variation> variations_of(const sim::Scene& best, const std::vector<Photo>& photos);

/// The systematic error of derived number `derived`: for each choice the mean square of its shifts less what
/// chance does, not below 0; the root of their sum. Rows that are refuted take no part;
/// none where no row has the number.
std::optional<double> systematic_error(const std::vector<StabilityRow>& rows, std::size_t derived);

/// Repeats the fit of `result` (of `photos`, in its order) for all of variations_of(), side by side on
/// options.threads, each on one; puts FitResult::stability and the systematic errors of derived numbers, and
/// assesses the quantities again with both errors. A fit that has failed or was interrupted
/// stays as it is; stopped meanwhile, validation_interrupted is set. Never throws for a variation that cannot
/// be fitted: it says why.
void assess_stability(const std::vector<Photo>& photos, const FitOptions& options, FitResult& result);

}  // namespace vegard::fit
