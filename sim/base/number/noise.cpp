#include "sim/base/number/noise.h"

#include <cmath>

namespace vegard::sim {
namespace {

/// The way from a node, (x, y, z), times the node's gradient.
double slope(std::uint32_t random, double x, double y, double z) {
  const std::uint32_t edge = static_cast<std::uint32_t>((static_cast<std::uint64_t>(random) * 12u) >> 32);
  const double a = edge < 4 ? y : x, b = edge < 8 ? z : y;
  return ((edge & 1) != 0 ? -a : a) + ((edge & 2) != 0 ? -b : b);
}

}  // namespace

double gradient_noise(std::uint64_t seed, Stream stream, std::uint64_t address, double x, double y,
                      double z) {
  const double fx = std::floor(x), fy = std::floor(y), fz = std::floor(z);
  const double rx = x - fx, ry = y - fy, rz = z - fz;
  const auto word = [](double floor) { return static_cast<std::uint32_t>(static_cast<std::int64_t>(floor)); };
  // Three indices are the node's: the address goes into the key.
  const std::uint64_t key = seed ^ address * 0x9E3779B97F4A7C15u;
  const auto corner = [&](int i, int j, int k) {
    const Words words = random_words(key, stream, word(fx) + i, word(fy) + j, word(fz) + k);
    return slope(words[0], rx - i, ry - j, rz - k);
  };
  const double u = noise_fade(rx), v = noise_fade(ry), w = noise_fade(rz);
  return noise_mix(noise_mix(noise_mix(corner(0, 0, 0), corner(1, 0, 0), u),
                             noise_mix(corner(0, 1, 0), corner(1, 1, 0), u), v),
                   noise_mix(noise_mix(corner(0, 0, 1), corner(1, 0, 1), u),
                             noise_mix(corner(0, 1, 1), corner(1, 1, 1), u), v),
                   w);
}

double octave_noise(std::uint64_t seed, Stream stream, std::uint32_t address, int octaves, double x, double y,
                    double z) {
  double sum = 0.0, size = 1.0, scale = 1.0;
  for (int k = 0; k < octaves; ++k) {
    sum += size * gradient_noise(seed, stream,
                                 static_cast<std::uint64_t>(address) << 8 | static_cast<std::uint64_t>(k + 1),
                                 x * scale, y * scale, z * scale);
    size *= 0.5;
    scale *= 2.0;
  }
  return sum;
}

}  // namespace vegard::sim
