// Whether a [[footprint]] has a spline.
#pragma once

#include "sim/scene/structs/footprint.h"

namespace vegard::sim {

/// True if the footprint's light stands along its spline. Noise around the Earth shines along one if any of
/// its points' numbers are given.
inline bool has_spline(const Footprint& f) {
  return f.source == FootprintSource::spline ||
         (f.shape == FootprintShape::shell && f.source == FootprintSource::noise &&
          !(f.latitude_deg.empty() && f.longitude_deg.empty()));
}

}  // namespace vegard::sim
