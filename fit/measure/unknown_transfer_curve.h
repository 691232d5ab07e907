// Photographs with an unknown transfer curve: decoding by a trial curve, and the likelihood by which trial
// curves are compared.
//
// A fit compares means of decoded pixels, so that the data themselves depend on the curve. Therefore chi2
// alone cannot compare two curves: one that maps all light to nearly the same value fits anything.
// Likelihoods of the numbers in the file can be compared. With a bin's light y(v) for its mean code v, the
// density of v is that of y times dy/dv, and with Gaussian errors sigma of the light
//   -2 ln p(v) = sum ((y - model) / sigma)^2 + 2 sum ln(sigma / (dy/dv)) + constant,
// so that errors are measured in codes. This does not change if the curve is multiplied by a constant, for
// which the gain compensates. If sigma is the noise of the codes, the second sum does not depend on the
// curve. It matters for errors that are proportional to the light (fit.model_error).
#pragma once

#include <vector>

#include "fit/measure/bin_grid.h"
#include "fit/measure/profile.h"
#include "fit/photo/photo.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::fit {

/// Decodes a photograph of integers, given as decoded by sRGB, by another curve.
Photo decoded_by(const Photo& as_srgb, const sim::BentSrgb& curve);

/// Returns the mean of d light / d encoded value in the bins of a grid, smoothed like the data. At code 0 the
/// slope of half a code is used, where it is finite and above 0.
std::vector<double> mean_slopes(const Photo& as_srgb, const sim::BentSrgb& curve,
                                const std::shared_ptr<const BinGrid>& grid, double smoothing_px);

/// Returns 2 sum ln(sigma / slope) over the values that have a sigma.
double log_determinant(const std::vector<double>& sigma, const std::vector<double>& slopes);

/// Returns -2 ln of the likelihood, up to a constant, maximised over a common factor s^2 >= 1 on the errors'
/// variances: chi2 up to n, and n + n ln(chi2 / n) above, so that underestimated errors do not dominate.
double scaled_chi2(double chi2, int n);

}  // namespace vegard::fit
