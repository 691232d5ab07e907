// The light behind the aurora.
#pragma once

#include "sim/base/image.h"
#include "sim/scene/scene.h"

namespace vegard::sim {

/// Adds the sky to a linear RGB image: level + gradient * (y / height - 1/2) per channel, y at the pixel's
/// centre.
void add_sky(const Sky& sky, Image& rgb);

}  // namespace vegard::sim
