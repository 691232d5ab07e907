// What of a scene's Sun is drawn along rays as strands or shells: loops, bundles, ejections.
#pragma once

#include <memory>
#include <vector>

#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Adds the emitters of loops without a grid (voxel = 0), of bundles and of ejections.
template <class T>
void add_strand_emitters(const Scene& scene, const NumberAs<T>& number,
                         std::vector<std::unique_ptr<Emitter<T>>>& all);

}  // namespace vegard::sim
