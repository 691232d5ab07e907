// Numbers beside a map that are known only so well: where the camera points, the air, the field.
//
// A map makes up for what is wrong with them (a camera that is said to look half a degree too high has its
// aurora farther away), so the photographs do not constrain them. What is known of them beforehand, the
// priors of fit.free, goes into the error bars: each perturbed solution has values of its own, drawn from
// them.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct MapNumber {
  std::string label;  ///< as reports write it: "camera.azimuth_deg of south"
  std::string unit;   ///< empty if it has none
  std::string path;   ///< in the scene
  std::string photo;  ///< of whose photograph alone; empty: of all
  double value = 0.0;
  double error = 0.0;  ///< standard deviation of the prior
  double min = 0.0, max = 0.0;
};

/// Those of the scene's fit.free that belong to the camera, the air, the field or the blur. The rest is
/// passed over: a map solves for the light of emitters, the sky and the gains itself. Throws
/// sim::Error(scene) as fit.free does, and for one without a normal prior about the scene's own value.
std::vector<MapNumber> map_numbers(const sim::Scene& scene);

/// The scene with other values of these numbers, moved inside their limits.
sim::Scene scene_with(sim::Scene scene, const std::vector<MapNumber>& numbers,
                      const std::vector<double>& values);

}  // namespace vegard::fit
