// Fitting a scene together with the transfer curve of its photograph.
//
// Gains and sky are solved, and a change of the curve changes the data: so it is searched about the fit. A
// whole search with the curve taken as sRGB; then a search of the curve's one or two numbers
// (sim/base/number/curve_search.h), by the likelihood of the file's numbers (fit/measure/unknown_curve.h),
// with a descent of everything else from the nearest answer at each place; then the answer with the curve
// that was found. The likelihood is divided by how many residuals go up and down together, as error bars are.
#pragma once

#include "fit/fit.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// Between which an exponent over sRGB's light is looked for: its inverse, and this.
inline constexpr double kMaxExponent = 4.0;

/// fit_photo() of a photograph whose curve is unknown (photo.unknowns numbers of it). Leaves the photograph
/// decoded by the curve that was found, and its `decoding` saying so. Error bars are as wide as the curve's
/// uncertainty makes them; gains and sky are those of the curve that was found. Throws sim::Error as
/// fit_photo() does, and for what does not go with an unknown curve: statistics other than the profile,
/// free-form height profiles, fit.photo_noise = "sensor", validation of the error bars.
FitResult fit_photo_and_curve(const sim::Scene& scene, Photo& photo, const FitOptions& options);

}  // namespace vegard::fit
