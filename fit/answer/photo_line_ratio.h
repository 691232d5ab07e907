// Ratios of lines as a photograph shows them, beside what the model's picture of it shows.
#pragma once

#include <vector>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// I(630.0)/I(557.7) and I(427.8)/I(557.7) "in the photograph" and "in the model's picture": the profile less
/// the solved sky, as brightness of lines (fit/measure/line_brightness.h), summed over the bins in which the
/// model has at least a tenth of its brightest 557.7 nm. Both ways alike, so that blur, air and what the
/// channels mix up do the same to both; unlike the ratios along the field they are those of the light in
/// view. A gain for all channels does nothing to them.
///
/// The photograph's sigma: noise of the bins, times the fit's inflation, and the solved sky level's, channels
/// taken as independent. Ratios are missing, and say why, where the channels have gains of their own, where
/// there are more lines than channels, and in a grid other than columns. Nothing of a line that a scene does
/// not have.
std::vector<DerivedNumber> photo_line_ratios(const FitResult& result);

}  // namespace vegard::fit
