// Grey sensors (sensor.response = "grey"), for pictures in one line, such as those of the Sun: only one
// channel is compared.
#pragma once

#include "sim/scene/structs/scene.h"
#include "sim/scene/structs/sensor.h"

namespace vegard::fit {

/// The one of a photograph's three channels that is compared if the sensor is grey.
constexpr int kGreyChannel = 1;

inline bool is_grey(const sim::Scene& scene) {
  return sim::response_kind(scene.sensor.response) == sim::ResponseKind::grey;
}

/// True if the channel is compared: all channels, but only kGreyChannel of a grey sensor.
inline bool has_channel(const sim::Scene& scene, int channel) {
  return !is_grey(scene) || channel == kGreyChannel;
}

}  // namespace vegard::fit
