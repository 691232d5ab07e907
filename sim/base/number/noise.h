// Gradient noise in three dimensions.
//
// Source: K. Perlin, "Improving noise", SIGGRAPH 2002: gradients towards the twelve edges of a cube, weighted
// by the quintic 6t⁵ - 15t⁴ + 10t³. Instead of his permutation table, counter-based random numbers give a
// node's gradient, so that the noise never repeats and is a pure function of the seed.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "sim/base/number/dual.h"
#include "sim/base/number/random.h"

namespace vegard::sim {

/// Returns the noise at a point: 0 at the nodes, which are the points with integer coordinates; between about
/// -1 and 1; continuous, with continuous first and second derivatives.
double gradient_noise(std::uint64_t seed, Stream stream, std::uint64_t address, double x, double y, double z);

/// Returns the sum of independent octaves of gradient_noise(), each with half the wavelength and amplitude of
/// the previous one.
double octave_noise(std::uint64_t seed, Stream stream, std::uint32_t address, int octaves, double x, double y,
                    double z);

/// Rises from 0 to 1 with zero first and second derivatives at both ends.
inline double noise_fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }
inline double noise_mix(double a, double b, double t) { return a + t * (b - a); }

/// Noise at a point, and its gradient.
struct NoiseAt {
  double value, slope[3];
};

/// The same noise from a table, for density maps, which evaluate it a hundred million times: the gradients at
/// the nodes are drawn once, for a periodic cube of kPeriod nodes per side.
class NoiseLattice {
 public:
  static constexpr int kPeriod = 64;
  static constexpr double kLargest = 1.04;  ///< bound of the absolute value

  /// The noise of a seed, a stream and an address, such as that of one of several nodes.
  NoiseLattice(std::uint64_t seed, Stream stream, std::uint32_t address);

  /// Returns the noise: 0 at points with integer coordinates; continuous with its first and second
  /// derivatives.
  double value(double x, double y, double z) const;
  NoiseAt with_slope(double x, double y, double z) const;

 private:
  std::vector<std::uint8_t> edge_;  ///< [z][y][x], 0 to 11
};

inline double noise_of(const NoiseLattice& lattice, const double point[3]) {
  return lattice.value(point[0], point[1], point[2]);
}

template <class D>
Dual<double, D> noise_of(const NoiseLattice& lattice, const Dual<double, D> point[3]) {
  const NoiseAt at = lattice.with_slope(point[0].v, point[1].v, point[2].v);
  return {at.value, point[0].d * at.slope[0] + point[1].d * at.slope[1] + point[2].d * at.slope[2]};
}

}  // namespace vegard::sim
