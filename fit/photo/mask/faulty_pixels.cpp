#include "fit/photo/mask/faulty_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fit/photo/mask/plane.h"
#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace {

constexpr float kNeighboursShare = 0.15f;
constexpr float kRanges = 2.0f;

struct Neighbours {
  float median, range, direct_mean;
};

/// Returns the statistics of the eight neighbours of a pixel that is not at the edge.
Neighbours neighbours_of(const Plane& light, int x, int y) {
  std::array<float, 8> around = {light.at(x - 1, y - 1), light.at(x, y - 1),    light.at(x + 1, y - 1),
                                 light.at(x - 1, y),     light.at(x + 1, y),    light.at(x - 1, y + 1),
                                 light.at(x, y + 1),     light.at(x + 1, y + 1)};
  const float direct = (around[1] + around[3] + around[4] + around[6]) / 4.0f;
  std::sort(around.begin(), around.end());
  return {(around[3] + around[4]) / 2.0f, around[7] - around[0], direct};
}

/// Returns the median of the sixteen pixels around the eight neighbours, as far as they are in the picture.
float median_two_away(const Plane& light, int x, int y) {
  std::vector<float> ring;
  for (int v = y - 2; v <= y + 2; ++v)
    for (int u = x - 2; u <= x + 2; ++u)
      if (std::max(std::abs(u - x), std::abs(v - y)) == 2 && u >= 0 && v >= 0 && u < light.width &&
          v < light.height)
        ring.push_back(light.at(u, v));
  return sim::median(ring);
}

}  // namespace

PixelSet hot_pixels(const Photo& photo, const HotPixelSettings& settings) {
  PixelSet set(photo.linear.width, photo.linear.height);
  for (int channel = 0; channel < 3; ++channel) {
    const Plane light = channel_light(photo, channel);
    Plane excess(light.width, light.height);
    for (int y = 1; y + 1 < light.height; ++y)
      for (int x = 1; x + 1 < light.width; ++x)
        excess.at(x, y) = light.at(x, y) - neighbours_of(light, x, y).median;
    const LocalNoise noise(excess, light, [&](double level) { return code_step(photo, level); });
    for (int y = 1; y + 1 < light.height; ++y)
      for (int x = 1; x + 1 < light.width; ++x) {
        const float e = excess.at(x, y);
        if (std::abs(e) <= settings.sigmas * noise.at(x, y).sigma) continue;
        const Neighbours around = neighbours_of(light, x, y);
        const float sky = median_two_away(light, x, y), sign = e > 0.0f ? 1.0f : -1.0f;
        const float spread = (around.direct_mean - sky) * sign;
        if (std::abs(e) > kRanges * around.range && spread < kNeighboursShare * std::abs(e)) set.at(x, y) = 1;
      }
  }
  return set;
}

PixelSet saturated_pixels(const Photo& photo, const SaturationSettings& settings) {
  PixelSet set(photo.linear.width, photo.linear.height);
  for (std::size_t i = 0; i < set.in.size(); ++i)
    set.in[i] = !photo.usable[3 * i] || !photo.usable[3 * i + 1] || !photo.usable[3 * i + 2];
  return grown(set, settings.border_px);
}

}  // namespace vegard::fit
