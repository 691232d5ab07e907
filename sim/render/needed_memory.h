// Estimates of the memory that pictures take, made before any memory is allocated.
#pragma once

#include "sim/base/memory_limit.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// What the caller does with a rendering, and the bytes per pixel that this takes.
struct RenderingUse {
  bool sheet_layers = false;
  double bytes_per_px = 0.0;  ///< in addition to the rendering
  /// Whether codecs with hundreds of libraries are loaded: all but that of PNGs.
  bool loads_codecs = true;
};

/// Returns the peak number of bytes of render() and of the use that follows, for a film that is lit
/// everywhere. It is an upper bound, too large by less than a third for a picture full of light on two cores.
/// It does not include the files of the scene's volumes and their grids, which do not depend on the camera,
/// nor the memory of the program itself (kProgramBytes).
double render_bytes(const Scene& scene, int threads, const RenderingUse& use);

/// Memory of the program with its libraries and tables before it does anything, and of that what the codecs
/// of pictures take.
inline constexpr double kProgramBytes = 160.0 * 1024.0 * 1024.0, kCodecBytes = 112.0 * 1024.0 * 1024.0;

/// Returns the largest number of threads, up to `threads` (0: all cores), with which a picture of the scene
/// can be made within the limit. The picture does not depend on it. Throws as require_memory() does if one
/// thread needs too much.
int threads_to_render(const Scene& scene, int threads, const RenderingUse& use, const MemoryLimit& limit);

/// Returns the bytes of one model of a photograph that a fit differentiates with respect to `free`
/// parameters, on a film of `cells` cells.
double model_bytes(const Scene& scene, double cells, int free, int threads);

}  // namespace vegard::sim
