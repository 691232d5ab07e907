// Fits a scene together with the unknown transfer curve of its photograph.
//
// A change of the curve changes the data themselves, so the curve cannot be one more parameter of the fit; it
// is searched for outside of it. First comes a whole search with the curve taken as sRGB. Then the curve's
// one or two numbers are searched (sim/base/number/curve_search.h) by the likelihood of the file's numbers
// (fit/measure/unknown_curve.h); for each trial curve all other parameters are fitted by a descent from the
// answer at the nearest earlier trial. The final answer is computed with the curve that was found. The
// likelihood is divided by the number of correlated residuals per independent one, as for error bars.
#pragma once

#include "fit/fit.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// Exponents over sRGB's light are searched between 1 / kMaxExponent and kMaxExponent.
inline constexpr double kMaxExponent = 4.0;

/// Does what fit_photo() does, for a photograph whose transfer curve has photo.unknowns unknown numbers.
/// Afterwards `photo` is decoded by the curve that was found, and its `decoding` says so. Error bars include
/// the uncertainty of the curve; gains and sky are those at the curve that was found. Throws sim::Error as
/// fit_photo() does, and for options that an unknown curve excludes: statistics other than the profile,
/// free-form height profiles, fit.photo_noise = "sensor", validation of the error bars.
FitResult fit_photo_and_transfer_curve(const sim::Scene& scene, Photo& photo, const FitOptions& options);

}  // namespace vegard::fit
