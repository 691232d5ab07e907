// A sine's phase, counted from where the camera looks instead of from the sheet's far end.
//
// The phase of a scene is counted from the sheet's start, hundreds of kilometres out of view: the slightest
// change of the wavelength there turns the sine in view by radians. A valley of chi2 in wavelength and phase
// is then long, narrow and curved, and a descent creeps along it. With the phase in view for a coordinate it
// is short and straight.
#pragma once

#include <vector>

#include "fit/parameters/free_parameters.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct PhaseAnchor {
  int phase = 0, wavelength = 0;     ///< indices among the numbers that move
  double distance_km = 0.0;          ///< along the sheet, from its start to the point in view
  double start_wavelength_km = 0.0;  ///< where both phases are the same number

  /// What the phase in view is more than the phase at the start, but for a constant; and its derivative by
  /// the wavelength.
  double more(double wavelength_km) const;
  double slope(double wavelength_km) const;
};

/// One for every sheet of which both are among `moved`. `values` are those of `moved`, `scene` holds them and
/// the rest. The point in view is where the camera's azimuth meets the sheet, else the sheet's middle.
std::vector<PhaseAnchor> phase_anchors(const sim::Scene& scene, const std::vector<FreeNumber>& moved,
                                       const std::vector<double>& values);

}  // namespace vegard::fit
