// Automatic exposure: finds the sensor's gain at which almost no pixel is overexposed.
#pragma once

#include <optional>

#include "sim/render/render.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the scene with the sensor's gain changed so that in its picture, sky and stars included, one pixel
/// in a thousand has a channel above `white` (1 is white). With sensor.exposure = "camera" it changes the ISO
/// number instead. The gain is found from a picture of at most 320 x 320 pixels without the pictures of
/// [composite] and does not depend on the scene's own gain. Returns nothing if no gain within its limits does
/// so: fewer pixels have any light, or more are above `white` by light that the gain does not change
/// (sky.level).
std::optional<Scene> auto_exposed(const Scene& scene, double white = 0.95, RenderOptions options = {});

}  // namespace vegard::sim
