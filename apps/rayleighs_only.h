// What is only true of a picture in rayleighs.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Throws Error(scene), with the key's place, if the scene's points are of unit weight (film.weight), so that
/// its picture is none in rayleighs. `what` needs them: "--as-seen".
void require_rayleighs(const sim::Scene& scene, const std::string& what);

}  // namespace vegard::apps
