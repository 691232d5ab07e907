// The emitters of a scene: one for each footprint, nebula and grid.
#pragma once

#include <memory>
#include <vector>

#include "sim/light/emitter.h"
#include "sim/render/volumes/volume_files.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// `number` gives the scene's numbers as T. The emitters must not outlive scene and files. T is double or
/// FreeDual.
template <class T>
std::vector<std::unique_ptr<Emitter<T>>> make_emitters(const Scene& scene, const VolumeFiles& files,
                                                       const NumberAs<T>& number, int threads);

extern template std::vector<std::unique_ptr<Emitter<double>>> make_emitters(const Scene&, const VolumeFiles&,
                                                                            const NumberAs<double>&, int);
extern template std::vector<std::unique_ptr<Emitter<FreeDual>>> make_emitters(const Scene&,
                                                                              const VolumeFiles&,
                                                                              const NumberAs<FreeDual>&, int);

}  // namespace vegard::sim
