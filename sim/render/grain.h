// Grain: the random difference between pictures of two draws of the beams.
#pragma once

#include <vector>

#include "sim/render/render.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns, per line, the standard deviation of a pixel's light divided by its light, as root mean square
/// over the pixels with at least a tenth of the line's brightest light. It renders the scene once more with
/// the same options, with beams at the same feet but on other paths; the variance is half of the mean square
/// of the relative differences. 0 for a line without light. Not for the physical blur, whose rendering has no
/// such draw.
std::vector<double> grain_per_px(const Scene& scene, const Rendering& rendering, RenderOptions options = {});

}  // namespace vegard::sim
