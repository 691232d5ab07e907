#include "sim/render/grain.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace vegard::sim {

std::vector<double> grain_per_px(const Scene& scene, const Rendering& rendering, RenderOptions options) {
  assert(scene.blur.model == BlurModel::angle);
  ++options.path_draw;
  options.sheet_layers = false;
  options.memory = nullptr;
  const Image other = render(scene, options).rayleigh;
  const Image& one = rendering.rayleigh;
  std::vector<double> grain(static_cast<std::size_t>(one.channels()), 0.0);
  if (other.data.size() != one.data.size()) return grain;  // stopped
  for (int line = 0; line < one.channels(); ++line) {
    float peak = 0.0f;
    for (int y = 0; y < one.height; ++y)
      for (int x = 0; x < one.width; ++x) peak = std::max(peak, one.at(x, y, line));
    double square = 0.0, pixels = 0.0;
    for (int y = 0; y < one.height && peak > 0.0f; ++y)
      for (int x = 0; x < one.width; ++x) {
        const double a = one.at(x, y, line), b = other.at(x, y, line), mean = 0.5 * (a + b);
        if (mean < 0.1 * peak) continue;
        square += (a - b) * (a - b) / (2.0 * mean * mean);
        pixels += 1.0;
      }
    if (pixels > 0.0) grain[line] = std::sqrt(square / pixels);
  }
  return grain;
}

}  // namespace vegard::sim
