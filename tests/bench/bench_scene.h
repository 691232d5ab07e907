// The scenes that the benchmarks work on.
#pragma once

#include "sim/scene/structs/scene.h"

namespace vegard::bench {

/// An arc like that of a typical photograph (720 pixels across 59 degrees, three layers, E0 4.3 keV),
/// with this many beams per layer and 2 / path_step deflections per beam on average. About half of the path,
/// from 500 km down, is above the picture.
sim::Scene arc_scene(int width, int height, int beams, double path_step = 1.0 / 300.0);

}  // namespace vegard::bench
