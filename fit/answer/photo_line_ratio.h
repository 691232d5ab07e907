// Ratios of emission lines in a photograph and in the model's picture of it.
#pragma once

#include <vector>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// Returns I(630.0)/I(557.7) and I(427.8)/I(557.7) "in the photograph" and "in the model's picture": the
/// profile less the solved sky, as brightness of lines (fit/measure/line_brightness.h), summed over the bins
/// in which the model has at least a tenth of its brightest 557.7 nm. Both are computed alike, so blur, air
/// and the mixing of lines in the channels have the same effect on both. Unlike the ratios along the field,
/// they are those of the light in view. A gain common to all channels does not change them.
///
/// The photograph's sigma combines the noise of the bins, times the error inflation, with the error of the
/// solved sky level, channels taken as independent. Ratios have no value, and give the reason, where the
/// channels have separate gains, where there are more lines than channels, and for bins other than columns. A
/// line that the scene does not have gives no ratio.
std::vector<DerivedNumber> photo_line_ratios(const FitResult& result);

}  // namespace vegard::fit
