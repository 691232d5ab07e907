// Grain: what a picture of beams drawn at random differs by from another draw of them.
#pragma once

#include <vector>

#include "sim/render/render.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Standard deviation of a pixel's light over its light, per line, in the root mean square of the pixels that
/// have at least a tenth of the line's brightest: half of the mean square of the relative differences between
/// `rendering` and another whose beams stand where they stood and take other paths. 0 of a line without
/// light. Renders the scene once more, with the same options. Not for the physical blur, whose rendering has
/// no such draw.
std::vector<double> grain_per_px(const Scene& scene, const Rendering& rendering, RenderOptions options = {});

}  // namespace vegard::sim
