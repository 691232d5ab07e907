#include "sim/view/sky.h"

namespace vegard::sim {

void add_sky(const Sky& sky, Image& rgb) {
  for (int y = 0; y < rgb.height; ++y) {
    const double place = (y + 0.5) / rgb.height - 0.5;
    for (int x = 0; x < rgb.width; ++x)
      for (int c = 0; c < 3; ++c)
        rgb.at(x, y, c) += static_cast<float>(sky.level[c] + sky.gradient[c] * place);
  }
}

}  // namespace vegard::sim
