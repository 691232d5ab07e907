// Numbers other than the map itself that have known errors: the camera's pointing, the air, the field.
//
// A map can compensate for their errors (if the camera's pointing is taken half a degree too high, the aurora
// is placed farther away), so the photographs do not constrain them. Their priors (fit.free) contribute to
// the error bars: each perturbed solution uses its own values, drawn from the priors. The modes of the
// emission tables are numbers too; these are solved for with the map, and drawn from what the photographs
// leave open.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct MapNumber {
  std::string label;  ///< as in reports: "camera.azimuth_deg of south"
  std::string unit;   ///< empty if it has none
  std::string path;   ///< in the scene
  std::string photo;  ///< name of the photograph to which it belongs; empty: all
  double value = 0.0;
  double error = 0.0;  ///< standard deviation of the prior
  double min = 0.0, max = 0.0;
  int mode = -1;  ///< of the emission tables' uncertainty, from 0, which has no path; -1: another number
};

/// Returns the numbers in the scene's fit.free that belong to the camera, the air, the field or the blur.
/// Others are ignored: a map solves for the light of emitters, the sky and the gains itself. Throws
/// sim::Error(scene) as fit.free does, and for a number without a normal prior about the scene's own value.
std::vector<MapNumber> map_numbers(const sim::Scene& scene);

/// Returns the coefficients of the modes of the emission tables' uncertainty
/// (sim/light/tables/light_modes.h), with the standard deviation 1; none if the scene takes its tables as
/// exact, or they have no modes.
std::vector<MapNumber> mode_numbers(const sim::Scene& scene);

/// Returns the scene with other values of these numbers, moved inside their limits.
sim::Scene scene_with(sim::Scene scene, const std::vector<MapNumber>& numbers,
                      const std::vector<double>& values);

}  // namespace vegard::fit
