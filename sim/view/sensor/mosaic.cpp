#include "sim/view/sensor/mosaic.h"

#include <algorithm>
#include <cassert>

namespace vegard::sim {
namespace {

const char* letters_of(MosaicPattern pattern) {
  switch (pattern) {
    case MosaicPattern::rggb:
      return "rggb";
    case MosaicPattern::bggr:
      return "bggr";
    case MosaicPattern::grbg:
      return "grbg";
    case MosaicPattern::gbrg:
      return "gbrg";
    case MosaicPattern::none:
      break;
  }
  assert(false);
  return "gggg";
}

/// Sums of what enters a channel at a pixel.
struct Taken {
  double sum = 0.0;
  int count = 0;
};

Taken taken(const Image& mosaic, MosaicPattern pattern, int x, int y, int channel) {
  if (filter_of_pixel(pattern, x, y) == channel) return {mosaic.at(x, y, 0), 1};
  Taken t;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, mosaic.height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, mosaic.width - 1); ++u) {
      if (filter_of_pixel(pattern, u, v) != channel) continue;
      t.sum += mosaic.at(u, v, 0);
      ++t.count;
    }
  return t;
}

/// count_power: 1 for a mean, 2 for its variance.
Image demosaiced(const Image& mosaic, MosaicPattern pattern, int count_power) {
  assert(mosaic.channels() == 1 && mosaic.width > 1 && mosaic.height > 1);
  Image rgb(mosaic.width, mosaic.height, {"R", "G", "B"});
  for (int y = 0; y < mosaic.height; ++y)
    for (int x = 0; x < mosaic.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const Taken t = taken(mosaic, pattern, x, y, c);
        rgb.at(x, y, c) = static_cast<float>(t.sum / (count_power == 1 ? t.count : t.count * t.count));
      }
  return rgb;
}

}  // namespace

int filter_of_pixel(MosaicPattern pattern, int x, int y) {
  const char filter = letters_of(pattern)[2 * (y & 1) + (x & 1)];
  return filter == 'r' ? 0 : filter == 'g' ? 1 : 2;
}

Image demosaic(const Image& mosaic, MosaicPattern pattern) { return demosaiced(mosaic, pattern, 1); }

Image demosaic_variance(const Image& mosaic_variance, MosaicPattern pattern) {
  return demosaiced(mosaic_variance, pattern, 2);
}

}  // namespace vegard::sim
