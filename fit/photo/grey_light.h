// Light of one channel: pictures in one line, as the Sun's are (sensor.response = "grey").
#pragma once

#include "sim/scene/lines/camera_responses.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// The one of a photograph's three channels that is compared, where the sensor is grey.
constexpr int kGreyChannel = 1;

inline bool is_grey(const sim::Scene& scene) {
  return sim::response_kind(scene.sensor.response) == sim::ResponseKind::grey;
}

/// Whether a channel says anything that another does not.
inline bool has_channel(const sim::Scene& scene, int channel) {
  return !is_grey(scene) || channel == kGreyChannel;
}

}  // namespace vegard::fit
