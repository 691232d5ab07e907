// The light behind the aurora: the polynomial of [sky].
#pragma once

#include <array>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the factors of the sky's level, gradient and curvature at a vertical position (0 top, 1 bottom):
/// 1, p and p^2 - 1/12 with p = place - 1/2, so that the level is the mean over the picture.
std::array<double, 3> sky_basis(double place);

/// Adds the sky to a linear RGB image, at the pixels' centres.
void add_sky(const Sky& sky, Image& rgb);

}  // namespace vegard::sim
