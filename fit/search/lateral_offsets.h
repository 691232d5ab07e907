// Lateral offsets of a sheet, one per band: they give a first estimate of its sine without a starting value.
//
// Every band of a photograph sees its own stretch of a sheet, and to first order its profile shows how far to
// the side of the model's that stretch stands. These places, one a band, are all that the search for a
// wavelength has to look at: a sine through a few dozen points is a small linear problem for each wavelength.
#pragma once

#include <vector>

#include "fit/compare/profile_cost.h"

namespace vegard::fit {

/// The offset of the part of a sheet that a band sees.
struct LateralOffset {
  double along_km = 0.0;    ///< from the sheet's start, along its straight line
  double lateral_km = 0.0;  ///< of that line, to the side of the sine's positive values
  double sigma_km = 0.0;
};

/// The lateral offsets of all of a scene's sheets (arcs of a system count as one) that a photograph shows,
/// given a scene that is roughly right. Costs one Jacobian by two numbers per sheet. Bands that do not show a
/// sheet have no point.
std::vector<std::vector<LateralOffset>> lateral_offsets(Comparison& comparison, const sim::Scene& scene);

/// aside = offset + slope (along - middle) + amplitude sin(2 pi along / wavelength + phase)
struct SineThroughOffsets {
  double wavelength_km = 0.0, amplitude_km = 0.0, phase_rad = 0.0;
  double offset_km = 0.0, slope = 0.0;
  double chi2 = 0.0;  ///< what is believed of amplitude, offset and slope beforehand included
};

/// The best sine of every wavelength that is a local optimum between two limits, best first, at most `most`.
/// Amplitudes are believed to be some `amplitude_km`, lines to lie where they are to 20 km and 0.3.
std::vector<SineThroughOffsets> sines_through(const std::vector<LateralOffset>& offsets, double middle_km,
                                              double min_wavelength_km, double max_wavelength_km,
                                              double amplitude_km, int most);

}  // namespace vegard::fit
