#include "sim/view/film/brightest_spot.h"

#include <cassert>
#include <limits>

#include "sim/view/camera/camera.h"

namespace vegard::sim {

BrightSpot brightest_spot(const Image& rayleigh, const std::vector<double>& weights, const Camera& camera) {
  assert(rayleigh.channels() == static_cast<int>(weights.size()));
  BrightSpot spot;
  spot.value = -std::numeric_limits<double>::infinity();
  for (int y = 0; y < rayleigh.height; ++y) {
    for (int x = 0; x < rayleigh.width; ++x) {
      double sum = 0.0;
      for (std::size_t l = 0; l < weights.size(); ++l)
        sum += weights[l] * rayleigh.at(x, y, static_cast<int>(l));
      if (!(sum > spot.value)) continue;
      spot.value = sum;
      spot.x = x;
      spot.y = y;
    }
  }
  for (std::size_t l = 0; l < weights.size(); ++l)
    spot.rayleigh.push_back(rayleigh.at(spot.x, spot.y, static_cast<int>(l)));
  const Direction direction = direction_of_pixel(camera, spot.x + 0.5, spot.y + 0.5);
  spot.azimuth_deg = direction.azimuth_deg;
  spot.elevation_deg = direction.elevation_deg;
  return spot;
}

}  // namespace vegard::sim
