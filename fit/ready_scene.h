// The checks and the preparation that a scene needs before any work with it.
#pragma once

#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Validates the scene, reads the tables that it names again (a change may have named another one), and
/// checks height profiles, the free oxygen and the sensor's response against them. Throws Error(scene),
/// Error(unreadable_input).
void make_ready(sim::Scene& scene);

}  // namespace vegard::fit
