// How much memory pictures take, worked out before any is taken.
#pragma once

#include "sim/base/memory_limit.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// What is done with a rendering, and the bytes that this takes for each of its pixels.
struct RenderingUse {
  bool sheet_layers = false;
  double bytes_per_px = 0.0;  ///< beside the rendering
};

/// Bytes at the worst moment of render() and of what follows, as if all of the film were lit: from above, by
/// less than a third for a picture full of light on two cores. Files of the scene's volumes and their grids,
/// which do not depend on the camera, are not in it, nor is what the program takes for itself
/// (kProgramBytes).
double render_bytes(const Scene& scene, int threads, const RenderingUse& use);

/// What the program takes with its libraries and tables before it does anything.
inline constexpr double kProgramBytes = 160.0 * 1024.0 * 1024.0;

/// As many threads as may be used, at most the number asked for (0: all cores), so that a picture of the
/// scene can be made within the limit: the result is the same. Throws as require_memory() if one is too many.
int threads_to_render(const Scene& scene, int threads, const RenderingUse& use, const MemoryLimit& limit);

/// Bytes of one model of a photograph that a fit differentiates, on a film of so many cells.
double model_bytes(const Scene& scene, double cells, int free, int threads);

}  // namespace vegard::sim
