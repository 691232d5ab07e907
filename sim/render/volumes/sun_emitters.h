// The Sun's emitters: its photosphere and what stands on it.
#pragma once

#include <memory>
#include <vector>

#include "sim/light/emitter.h"
#include "sim/render/volumes/volume_files.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Adds those of a scene whose Sun is shown. They look into `scene` and `files`.
template <class T>
void add_sun_emitters(const Scene& scene, const VolumeFiles& files, const NumberAs<T>& number, int threads,
                      std::vector<std::unique_ptr<Emitter<T>>>& all);

}  // namespace vegard::sim
