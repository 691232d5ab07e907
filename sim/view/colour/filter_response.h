// The channels of an imager behind narrow filters, one per emission line: sensor.response = "filters".
#pragma once

#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/view/colour/matrix3.h"
#include "sim/view/colour/sensor_response.h"

namespace vegard::sim {

bool sees_through_filters(const Scene& scene);

/// Linear light per kilorayleigh of each of the scene's lines at a gain_per_kilorayleigh of 1: channel i has
/// 1 for line i and nothing for any other. Lines behind the third are seen by none.
std::vector<Vector3> filter_colours(const Scene& scene);

/// What the filters let through of other light: triangles around the lines' wavelengths, 5 nm wide at half
/// their height, which a spectrum in steps of 5 nm is summed under exactly. At the line itself a channel
/// gives 1 per kilorayleigh.
ChannelTable filter_channels(const Scene& scene);

}  // namespace vegard::sim
