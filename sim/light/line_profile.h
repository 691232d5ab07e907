// The height profile of light that no electrons excite: one line or continuum, as bright as given.
//
// The light follows the curve of a form (sim/light/form_profile.h). STEVE and the picket fence have such
// profiles: Archer et al. 2019, doi:10.1029/2019GL084473, saw them at 130 to 270 km and at 95 to 150 km.
#pragma once

#include <vector>

#include "sim/light/form_profile.h"
#include "sim/light/height_profile.h"

namespace vegard::sim {

/// The line, and the column brightness that its profile has below an altitude.
struct GivenLine {
  double wavelength_nm = 0.0;
  double rayleigh = 0.0;  ///< seen vertically
  double top_km = 0.0;
};

/// Returns the profile whose column_below(top_km) of the line is `rayleigh`; other wavelengths are dark. The
/// curve must have light below top_km. The derivative by the energy is 0.
HeightProfile line_profile(const std::vector<double>& wavelengths_nm, const GivenLine& line,
                           const FormCurve& curve);

/// Returns d rate / d one of the curve's numbers, indexed as HeightProfile::rate.
std::vector<float> line_profile_slope(const std::vector<double>& wavelengths_nm, const GivenLine& line,
                                      const FormCurve& curve, double FormCurve::*number);

}  // namespace vegard::sim
