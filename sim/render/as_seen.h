// A rendered picture as a dark-adapted eye sees it.
#pragma once

#include "sim/render/render.h"
#include "sim/view/colour/eye.h"

namespace vegard::sim {

/// Returns sRGB-encoded R, G, B from 0 to 1, as display_picture() does. The aurora's luminances are computed
/// from its rayleighs, so they depend neither on the sensor's gain nor on its responses. All other light is
/// known as sensor values only: it is taken as light of the displayed colour, with the luminance scale by
/// which 1 kR of 557.7 nm gives the sensor's gain_per_kilorayleigh. For `half_cd_m2` see displayed_as_seen().
/// If the scene has a sensor.colour_table, the table is applied to the grey of the result.
Image picture_as_seen(const Scene& scene, const Rendering& rendering, double half_cd_m2 = kSeenHalf_cd_m2);

}  // namespace vegard::sim
