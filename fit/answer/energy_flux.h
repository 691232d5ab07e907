// The energy flux Q of a sheet's electrons, computed from the gain of a fit where the sensor's scale is
// known.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

struct FoundFlux {
  double mw_m2 = 0.0;
  std::optional<double> sigma;
  std::vector<double> by_mode{};  ///< as FittedParameter::by_mode
};

/// Returns Q = (the scene's Q) * (fitted gain) / (known gain): brighter light and a higher gain give the same
/// picture. `known` is the scene before the fit, with the sensor's own scale; the fitted gain is the mean
/// over the bands. The relative sigma combines in quadrature that of this mean and that of the scale:
/// sensor.calibration_error, or for a camera known by its data sheet that of
/// sim/view/sensor/expected_counts.h (27 to 35 %). The mean's contains the data's noise, the other free
/// numbers (both with bands taken as independent), and the modes of the emission tables' uncertainty: the
/// change of light per flux that each brings, at the answer and by the answer's shift, of all bands together.
/// Returns none, with the reason in `why_none`, where the picture is not calibrated or Q does not scale the
/// light.
std::optional<FoundFlux> found_flux(const sim::Scene& known, const FittedPhoto& fitted, int sheet,
                                    std::string& why_none);

/// Does the same for a footprint, whose Q is at its spline, or where its picture is white.
std::optional<FoundFlux> found_flux_of_footprint(const sim::Scene& known, const FittedPhoto& fitted,
                                                 int footprint, std::string& why_none);

/// Returns "energy flux Q of the main sheet" for every sheet, and "of the arc footprint" for every footprint.
/// A flux that was free or tied has its fitted value. With several photographs, the one with the smallest
/// sigma gives the flux. `known` holds the scene of each photograph of the result.
std::vector<DerivedNumber> energy_fluxes(const std::vector<const sim::Scene*>& known,
                                         const FitResult& result);

}  // namespace vegard::fit
