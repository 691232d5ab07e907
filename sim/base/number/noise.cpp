#include "sim/base/number/noise.h"

#include <cmath>
#include <cstddef>

namespace vegard::sim {
namespace {

/// The way from a node, (x, y, z), times the node's gradient.
double slope(std::uint32_t random, double x, double y, double z) {
  const std::uint32_t edge = static_cast<std::uint32_t>((static_cast<std::uint64_t>(random) * 12u) >> 32);
  const double a = edge < 4 ? y : x, b = edge < 8 ? z : y;
  return ((edge & 1) != 0 ? -a : a) + ((edge & 2) != 0 ? -b : b);
}

constexpr int kMask = NoiseLattice::kPeriod - 1;

// The edges of a cube, twelve of them: where they point.
constexpr double kLatticeEdge[3][12] = {{1, -1, 1, -1, 1, -1, 1, -1, 0, 0, 0, 0},
                                        {1, 1, -1, -1, 0, 0, 0, 0, 1, -1, 1, -1},
                                        {0, 0, 0, 0, 1, 1, -1, -1, 1, 1, -1, -1}};

double fade_slope(double t) { return 30.0 * t * t * (t - 1.0) * (t - 1.0); }
/// A point's cell: its corners' places in the table, and where in it the point is.
struct Cell {
  std::size_t x[2], y[2], z[2];
  double rest[3];

  Cell(double px, double py, double pz) {
    const double fx = std::floor(px), fy = std::floor(py), fz = std::floor(pz);
    const std::int64_t ix = index(fx), iy = index(fy), iz = index(fz);
    for (int i = 0; i < 2; ++i) {
      x[i] = static_cast<std::size_t>((ix + i) & kMask);
      y[i] = static_cast<std::size_t>((iy + i) & kMask) * NoiseLattice::kPeriod;
      z[i] = static_cast<std::size_t>((iz + i) & kMask) * NoiseLattice::kPeriod * NoiseLattice::kPeriod;
    }
    rest[0] = px - fx;
    rest[1] = py - fy;
    rest[2] = pz - fz;
  }

  /// Where doubles are farther apart than cells, any cell may be taken.
  static std::int64_t index(double cell) {
    constexpr double kLatticeFar = 9007199254740992.0;
    return std::abs(cell) < kLatticeFar ? static_cast<std::int64_t>(cell) : 0;
  }
};

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

NoiseLattice::NoiseLattice(std::uint64_t seed, Stream stream, std::uint32_t address)
    : edge_(static_cast<std::size_t>(kPeriod) * kPeriod * kPeriod) {
  for (std::size_t first = 0; first < edge_.size(); first += 4) {
    const Words words = random_words(seed, stream, static_cast<std::uint32_t>(first), address);
    for (std::size_t i = 0; i < 4; ++i)
      edge_[first + i] = static_cast<std::uint8_t>((static_cast<std::uint64_t>(words[i]) * 12u) >> 32);
  }
}

double NoiseLattice::value(double px, double py, double pz) const {
  const Cell cell(px, py, pz);
  const double u = noise_fade(cell.rest[0]), v = noise_fade(cell.rest[1]), w = noise_fade(cell.rest[2]);
  const auto corner = [&](int i, int j, int k) {
    const int edge = edge_[cell.z[k] + cell.y[j] + cell.x[i]];
    return kLatticeEdge[0][edge] * (cell.rest[0] - i) + kLatticeEdge[1][edge] * (cell.rest[1] - j) +
           kLatticeEdge[2][edge] * (cell.rest[2] - k);
  };
  return noise_mix(noise_mix(noise_mix(corner(0, 0, 0), corner(1, 0, 0), u),
                             noise_mix(corner(0, 1, 0), corner(1, 1, 0), u), v),
                   noise_mix(noise_mix(corner(0, 0, 1), corner(1, 0, 1), u),
                             noise_mix(corner(0, 1, 1), corner(1, 1, 1), u), v),
                   w);
}

NoiseAt NoiseLattice::with_slope(double px, double py, double pz) const {
  const Cell cell(px, py, pz);
  double corner[8], weight[3][2], weight_slope[3];
  int edge[8];
  for (int axis = 0; axis < 3; ++axis) {
    weight[axis][1] = noise_fade(cell.rest[axis]);
    weight[axis][0] = 1.0 - weight[axis][1];
    weight_slope[axis] = fade_slope(cell.rest[axis]);
  }
  NoiseAt at{value(px, py, pz), {0.0, 0.0, 0.0}};
  for (int n = 0; n < 8; ++n) {
    const int i = n & 1, j = n >> 1 & 1, k = n >> 2;
    edge[n] = edge_[cell.z[k] + cell.y[j] + cell.x[i]];
    corner[n] = kLatticeEdge[0][edge[n]] * (cell.rest[0] - i) +
                kLatticeEdge[1][edge[n]] * (cell.rest[1] - j) + kLatticeEdge[2][edge[n]] * (cell.rest[2] - k);
    const double all = weight[0][i] * weight[1][j] * weight[2][k];
    for (int axis = 0; axis < 3; ++axis) at.slope[axis] += all * kLatticeEdge[axis][edge[n]];
    at.slope[0] += (i == 1 ? 1.0 : -1.0) * weight_slope[0] * weight[1][j] * weight[2][k] * corner[n];
    at.slope[1] += (j == 1 ? 1.0 : -1.0) * weight_slope[1] * weight[0][i] * weight[2][k] * corner[n];
    at.slope[2] += (k == 1 ? 1.0 : -1.0) * weight_slope[2] * weight[0][i] * weight[1][j] * corner[n];
  }
  return at;
}

}  // namespace vegard::sim
