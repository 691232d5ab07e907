// The scenes that the benchmarks work on.
#pragma once

#include "sim/scene/scene.h"

namespace vegard::bench {

/// An arc like that of a typical photograph (720 pixels across 59 degrees, three layers, E0 4.3 keV, 600
/// deflections per beam on average), with this many beams per layer.
sim::Scene arc_scene(int width, int height, int beams);

}  // namespace vegard::bench
