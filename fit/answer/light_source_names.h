// Names of a scene's light sources for the messages of a fit.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// "aurora", "nebula" or "solar light". Grids of a scene with neither nebula nor Sun are most likely aurora;
/// a scene with some aurora is spoken of as aurora.
std::string light_noun(const sim::Scene& scene);

/// What makes the light, for "no light of the scene's ...": "sheets", "volumes", "Sun", "sheets and volumes".
std::string sources_of(const sim::Scene& scene);

}  // namespace vegard::fit
