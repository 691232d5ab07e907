// An exposure that shows all of the picture: neither white where it is brightest nor darker than it need be.
#pragma once

#include <optional>

#include "sim/render/render.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The scene with its sensor's gain such that of its picture, sky and stars included, one pixel in a thousand
/// has a channel above `white` (1 is white). With sensor.exposure = "camera" by its ISO number. Found in a
/// picture of at most 320 pixels without what a [composite] names, whatever the scene's own gain. None where
/// no gain within its limits does that: fewer pixels have any light, or more are above `white` by the light
/// that no gain changes (sky.level).
std::optional<Scene> auto_exposed(const Scene& scene, double white = 0.95, RenderOptions options = {});

}  // namespace vegard::sim
