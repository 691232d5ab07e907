// Names of a scene's light sources for the messages of a fit.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// "aurora", "nebula" or "solar light". Grids in a scene with neither nebula nor Sun are taken as aurora; so
/// is a scene of which only a part is aurora.
std::string light_noun(const sim::Scene& scene);

/// The kinds of light sources, for "no light of the scene's ...": "sheets", "volumes", "Sun", "sheets and
/// volumes".
std::string sources_of(const sim::Scene& scene);

}  // namespace vegard::fit
