// The stability of an answer under other choices: the part of the region that is compared, the number of
// bands, the terms of the sky, the air, the transfer curve, the model error.
//
// The fit is repeated from its answer with one choice changed at a time. The shift of a number beyond what
// chance explains is its systematic error. Chance: a fit of other data that overlap has the variance of the
// difference |sigma² - sigma'²| (R. Barlow, "Systematic errors: facts and fictions", Advanced Statistical
// Techniques in Particle Physics, Durham 2002, arXiv:hep-ex/0207026, section 4.2). A sky, an air or a curve
// that makes chi2 per degree of freedom more than twice as large is refuted by the picture itself, and its
// shifts are ignored.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"
#include "fit/search/fit_options.h"

namespace vegard::fit {

/// A variation: the scene with one choice changed.
struct Variation {
  std::string choice;                 ///< "region", "bands", "sky", "air", "curve", "model error"
  std::string name;                   ///< "without its left third"
  sim::Scene scene;                   ///< starts at the answer; descends without a search
  double transfer_curve_power = 1.0;  ///< power to which the photograph's linear light is raised
};

/// Returns the variations that make sense for `best`, the best scene of a FitResult: none of the air without
/// aurora or with free haze, none of the curve if the photographs were linear in their files or the curve was
/// fitted, none of the region for several photographs, across a loop or about the Sun's limb.
std::vector<Variation> variations_of(const sim::Scene& best, const std::vector<Photo>& photos);

/// Returns the systematic error of the derived number with index `derived`: the square root of the sum over
/// choices of the mean square shift less the variance by chance, where a choice adds at least 0. Refuted rows
/// are ignored. Returns none where no row has the number.
std::optional<double> systematic_error(const std::vector<StabilityRow>& rows, std::size_t derived);

/// Repeats the fit of `result` for all of variations_of(), in parallel on options.threads threads, one thread
/// per fit. Sets FitResult::stability and the systematic errors of derived numbers, and assesses their trust
/// again with both errors. `photos` are those of the result, in its order. A result that failed or was
/// interrupted is left unchanged. If the user stops the repetitions, sets validation_interrupted. Never
/// throws for a variation that cannot be fitted: its row gives the reason.
void assess_stability(const std::vector<Photo>& photos, const FitOptions& options, FitResult& result);

}  // namespace vegard::fit
