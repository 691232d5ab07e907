// The energy flux Q of a sheet's electrons, given by the gain that a fit has found, where the picture's own
// scale is known.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

struct FoundFlux {
  double mw_m2 = 0.0;
  std::optional<double> sigma;
};

/// Q = (the scene's Q) * (found gain) / (known gain): brighter light or a higher gain are the same picture.
/// `known` is the scene as it was before the fit, with the sensor's own scale; the found gain is the mean of
/// the bands'. Its relative sigma is that of this mean, bands taken as independent, and that of the scale, in
/// quadrature: sensor.calibration_error, or for a camera by its data sheet that of
/// sim/view/sensor/expected_counts.h (27 to 35 %). Nothing, and why, where the picture is not calibrated or Q
/// is not what scales the light.
std::optional<FoundFlux> found_flux(const sim::Scene& known, const FittedPhoto& fitted, int sheet,
                                    std::string& why_none);

/// The same of a footprint, whose Q is at its spline, or where its picture is white.
std::optional<FoundFlux> found_flux_of_footprint(const sim::Scene& known, const FittedPhoto& fitted,
                                                 int footprint, std::string& why_none);

/// "energy flux Q of the main sheet" of every sheet, and "of the arc footprint" of every footprint. One that
/// was free, or tied, is as it was found. Of several photographs it is given by the one whose answer has the
/// smallest sigma. `known` holds the scene of each photograph of the result.
std::vector<DerivedNumber> energy_fluxes(const std::vector<const sim::Scene*>& known,
                                         const FitResult& result);

}  // namespace vegard::fit
