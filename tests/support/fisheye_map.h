// The map of an equidistant fisheye that looks straight up.
#pragma once

#include <cmath>
#include <limits>

#include "sim/base/number/constants.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::tests {

/// North towards the picture's top and east to its left, as one sees it lying on the back; the horizon at
/// `radius_px` about the middle, nothing beyond.
inline sim::DirectionMap fisheye_map(int size_px, double radius_px) {
  sim::DirectionMap map;
  map.width = map.height = size_px;
  for (int y = 0; y < size_px; ++y)
    for (int x = 0; x < size_px; ++x) {
      const double right = x + 0.5 - 0.5 * size_px, up = 0.5 * size_px - (y + 0.5);
      const double elevation = 90.0 * (1.0 - std::hypot(right, up) / radius_px);
      double azimuth = std::atan2(-right, up) / sim::kRadiansPerDegree;
      if (azimuth < 0.0) azimuth += 360.0;
      const bool seen = elevation >= 0.0;
      constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
      map.azimuth_deg.push_back(seen ? static_cast<float>(azimuth) : kNowhere);
      map.elevation_deg.push_back(seen ? static_cast<float>(elevation) : kNowhere);
    }
  return map;
}

}  // namespace vegard::tests
