// Gradient noise in three dimensions.
//
// Source: K. Perlin, "Improving noise", SIGGRAPH 2002: gradients towards the twelve edges of a cube, weighted
// by the quintic 6t⁵ - 15t⁴ + 10t³. In place of his table of permutations a node's gradient comes from the
// counter-based random numbers, so that the noise never repeats and is a pure function of the seed.
#pragma once

#include <cstdint>

#include "sim/base/number/random.h"

namespace vegard::sim {

/// Noise at a point: 0 at the nodes, which are the points with integer coordinates; between about -1 and 1;
/// continuous, and so are its first and second derivatives.
double gradient_noise(std::uint64_t seed, Stream stream, std::uint64_t address, double x, double y, double z);

/// Octaves of it, each half as long and half as high as the one before, and independent of it.
double octave_noise(std::uint64_t seed, Stream stream, std::uint32_t address, int octaves, double x, double y,
                    double z);

/// From 0 to 1 with no slope and no bend at either end.
inline double noise_fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }
inline double noise_mix(double a, double b, double t) { return a + t * (b - a); }

}  // namespace vegard::sim
