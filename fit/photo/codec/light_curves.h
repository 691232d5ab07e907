// Transfer curves by samples and by the numbers of ITU-T H.273, for what files declare (declared_light.h).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fit/photo/codec/declared_light.h"

namespace vegard::fit {

/// Returns a curve by the linear light of encoded values that are evenly spaced from 0 to 1, which does not
/// fall: from black to white, straight between the samples.
std::shared_ptr<const sim::ToneCurve> curve_of_samples(const std::vector<double>& light,
                                                       const std::string& name);

/// How many samples hold each code of 8 bits exactly, and one of 16 bits to 1e-7 of white.
constexpr int kCurveSamples = 255 * 16 + 1;

/// Returns the curve of encoded values that are linear light to the power of 1 / gamma.
LightCurve gamma_curve(double gamma);

/// Returns the curve of a number of ITU-T H.273, table 3, with the light of white as 1; none for a number
/// that is unspecified (2) or reserved.
std::optional<LightCurve> curve_of_h273(int transfer);

}  // namespace vegard::fit
