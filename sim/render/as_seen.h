// A rendered picture as a dark-adapted eye sees it.
#pragma once

#include "sim/render/render.h"
#include "sim/view/colour/eye.h"

namespace vegard::sim {

/// sRGB-encoded R, G, B, 0 to 1, as display_picture(). The aurora's luminances come from its rayleighs, so
/// that they depend neither on the sensor's gain nor on its responses. Whatever else is in the picture is
/// there in the sensor's values only: those count as light of the colour they show, 1 kR of 557.7 nm at the
/// sensor's gain_per_kilorayleigh. `half_cd_m2`: displayed_as_seen(). A scene's
/// sensor.colour_table colours what is seen by its grey.
Image picture_as_seen(const Scene& scene, const Rendering& rendering, double half_cd_m2 = kSeenHalf_cd_m2);

}  // namespace vegard::sim
