// The footprints of a scene as emitters, and as fields in space.
#pragma once

#include <memory>

#include "sim/light/emitter.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// T is double or FreeDual. The footprint is one of the scene's.
template <class T>
std::unique_ptr<Emitter<T>> footprint_emitter(const Scene& scene, const Footprint& footprint,
                                              const VolumeFiles& files, const NumberAs<T>& number,
                                              int threads);

/// As a field in the observer's east, north and up.
std::unique_ptr<LightField> footprint_field(const Scene& scene, const Footprint& footprint,
                                            const VolumeFiles& files, int threads);

}  // namespace vegard::sim
