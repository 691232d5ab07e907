// A photograph whose transfer curve nobody knows, looked at through one that is tried.
//
// What is compared are means of decoded pixels, so that the data themselves depend on the curve, and chi2 of
// two curves says nothing by itself: a curve that crushes all light to nearly the same value fits anything.
// Likelihoods of the numbers in the file can be compared. With a bin's light y(v) for its mean code v, the
// density of v is that of y times dy/dv, and with Gaussian errors sigma of the light
//   -2 ln p(v) = sum ((y - model) / sigma)^2 + 2 sum ln(sigma / (dy/dv)) + constant,
// so that the errors count as they are in codes. It does not change if a curve is multiplied by a constant,
// which a gain makes up for, nor, where sigma is the noise of the codes, with the curve at all but for chi2.
// Errors that are a share of the light (fit.model_error) are what the second sum weighs.
#pragma once

#include <vector>

#include "fit/measure/bin_grid.h"
#include "fit/measure/profile.h"
#include "fit/photo/photo.h"
#include "sim/view/sensor/transfer_curve.h"

namespace vegard::fit {

/// A photograph of integers that was decoded as sRGB, decoded by another curve.
Photo decoded_by(const Photo& as_srgb, const sim::BentSrgb& curve);

/// Mean d light / d encoded value in the bins of a profile of it, smoothed like the data. A code of 0 counts
/// as half a code, where the slope is finite and above 0.
std::vector<double> mean_slopes(const Photo& as_srgb, const sim::BentSrgb& curve,
                                const std::shared_ptr<const BinGrid>& grid, double smoothing_px);

/// 2 sum ln(sigma / slope) over the values that have a sigma.
double log_determinant(const std::vector<double>& sigma, const std::vector<double>& slopes);

/// chi2 with the errors' common scale s^2 >= 1 at its likeliest, -2 ln of the likelihood but for a constant:
/// chi2 up to n, and n + n ln(chi2 / n) beyond, since errors that are too small are not to rule.
double scaled_chi2(double chi2, int n);

}  // namespace vegard::fit
