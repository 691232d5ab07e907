// Lateral offsets of a sheet, one per band: they give a first estimate of its sine without a starting value.
//
// Every band of a photograph shows another part of a sheet, and its profile gives to first order the lateral
// distance of this part from the model's. The search for a wavelength needs only these offsets: a sine
// through a few dozen points is a small linear problem for each wavelength.
#pragma once

#include <vector>

#include "fit/compare/profile_cost.h"

namespace vegard::fit {

/// The lateral offset of the part of a sheet that a band shows.
struct LateralOffset {
  double along_km = 0.0;    ///< position along the sheet's straight line, from its start
  double lateral_km = 0.0;  ///< distance from this line, positive on the side of the sine's positive values
  double sigma_km = 0.0;    ///< error bar of lateral_km
};

/// Returns, for each of the scene's sheets (the arcs of a system count as one), the lateral offsets that the
/// photograph shows. The scene must be roughly right. It evaluates one Jacobian by two numbers per sheet.
/// Bands that do not show a sheet have no point.
std::vector<std::vector<LateralOffset>> lateral_offsets(Comparison& comparison, const sim::Scene& scene);

/// lateral = offset + slope (along - middle) + amplitude sin(2 pi along / wavelength + phase)
struct SineThroughOffsets {
  double wavelength_km = 0.0, amplitude_km = 0.0, phase_rad = 0.0;
  double offset_km = 0.0, slope = 0.0;
  double chi2 = 0.0;  ///< including the priors of amplitude, offset and slope
};

/// Returns the best sines, best first, at most `most` of them: one for each wavelength between the limits
/// that is a local minimum of chi2. Priors: amplitude of the order of `amplitude_km`, offset 0 ± 20 km, slope
/// 0 ± 0.3.
std::vector<SineThroughOffsets> sines_through(const std::vector<LateralOffset>& offsets, double middle_km,
                                              double min_wavelength_km, double max_wavelength_km,
                                              double amplitude_km, int most);

}  // namespace vegard::fit
