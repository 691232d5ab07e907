// Points in space that emit light: the deflection points of beams for other rendering programs
// (sim/render/beams/points.h).
#pragma once

#include <cstddef>
#include <vector>

namespace vegard::sim {

/// A batch of points, in order.
struct EmissionPoints {
  int lines = 0;
  std::vector<float> position_in_enu_km;  ///< [point * 3]: east, north, up of the observer
  std::vector<float> photons_per_s;       ///< [point * lines + line], into all directions

  std::size_t size() const { return position_in_enu_km.size() / 3; }
  void clear() {
    position_in_enu_km.clear();
    photons_per_s.clear();
  }
};

}  // namespace vegard::sim
