// The refusal of radars where nothing would be made of them.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Throws Error(scene) if the scene has a [[fit.radar]]; `what`, "a map", is the subject of the message.
void refuse_radars(const sim::Scene& scene, const std::string& what);

}  // namespace vegard::fit
