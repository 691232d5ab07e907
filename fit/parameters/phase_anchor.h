// The phase of a sheet's sine at a point in view, as the solver's coordinate instead of the phase at the
// sheet's start.
//
// The phase of a scene is that at the sheet's start, hundreds of kilometres out of view: the slightest change
// of the wavelength shifts the sine in view by radians. In wavelength and phase, the valley of chi2 is then
// long, narrow and curved, and a descent is very slow along it. With the phase in view as coordinate it is
// short and straight.
#pragma once

#include <vector>

#include "fit/parameters/free_parameters.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct PhaseAnchor {
  int phase = 0, wavelength = 0;     ///< indices among the varying numbers
  double distance_km = 0.0;          ///< along the sheet, from its start to the point in view
  double start_wavelength_km = 0.0;  ///< wavelength at which both phases are equal

  /// The phase in view less the phase at the start, up to a constant; and its derivative by the wavelength.
  double more(double wavelength_km) const;
  double slope(double wavelength_km) const;
};

/// Returns an anchor for every sheet whose phase and wavelength are both among `moved`. `values` are those of
/// `moved`; `scene` contains them. The point in view is where the camera's azimuth meets the sheet, else the
/// sheet's middle.
std::vector<PhaseAnchor> phase_anchors(const sim::Scene& scene, const std::vector<FreeNumber>& moved,
                                       const std::vector<double>& values);

}  // namespace vegard::fit
