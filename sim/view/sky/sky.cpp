#include "sim/view/sky/sky.h"

namespace vegard::sim {

std::array<double, 3> sky_basis(double place) {
  const double p = place - 0.5;
  return {1.0, p, p * p - 1.0 / 12.0};
}

void add_sky(const Sky& sky, Image& rgb) {
  for (int y = 0; y < rgb.height; ++y) {
    const std::array<double, 3> basis = sky_basis((y + 0.5) / rgb.height);
    for (int c = 0; c < 3; ++c) {
      const double light = sky.level[c] * basis[0] + sky.gradient[c] * basis[1] + sky.curvature[c] * basis[2];
      for (int x = 0; x < rgb.width; ++x) rgb.at(x, y, c) += static_cast<float>(light);
    }
  }
}

}  // namespace vegard::sim
