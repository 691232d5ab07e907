// Loops that are drawn by a grid (`voxel` above 0): the strands are put on voxels, blurred and sharpened, and
// the grid is drawn like a volume in the Sun's frame (sim/emit/grid/).
#pragma once

#include <cstdint>
#include <memory>

#include "sim/base/grid/sparse_grid.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the density of loop `index` on voxels at an instant of the scene's clock, in the Sun's frame and
/// unit, after its passes of blur and sharpen: one channel, "density". Throws Error(scene) with the key of
/// `voxel` if it would take more than `memory_limit` bytes.
SparseGrid loop_grid(const Scene& scene, std::uint32_t index, double instant_s, int threads,
                     std::uint64_t memory_limit = std::uint64_t{4} << 30);

/// Makes the emitter of this grid. For T = FreeDual the derivatives are those with respect to the positions
/// of camera and Sun; the loop's own parameters must not be free (sim/scene/emitters/loop.cpp).
template <class T>
std::unique_ptr<Emitter<T>> loop_grid_emitter(const Scene& scene, std::uint32_t index, double instant_s,
                                              const NumberAs<T>& number, int threads);

/// Makes the grid's field in space at time.start_s; it is dark within the photosphere.
std::unique_ptr<LightField> loop_grid_field(const Scene& scene, std::uint32_t index, int threads,
                                            std::uint64_t memory_limit = std::uint64_t{4} << 30);

extern template std::unique_ptr<Emitter<double>> loop_grid_emitter(const Scene&, std::uint32_t, double,
                                                                   const NumberAs<double>&, int);
extern template std::unique_ptr<Emitter<FreeDual>> loop_grid_emitter(const Scene&, std::uint32_t, double,
                                                                     const NumberAs<FreeDual>&, int);

}  // namespace vegard::sim
