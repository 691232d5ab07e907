// Gradient noise in three dimensions.
//
// Source: K. Perlin, "Improving noise", SIGGRAPH 2002: gradients towards the twelve edges of a cube, weighted
// by the quintic 6t⁵ - 15t⁴ + 10t³. Instead of his permutation table, counter-based random numbers give a
// node's gradient, so that the noise never repeats and is a pure function of the seed.
#pragma once

#include <cstdint>

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

}  // namespace vegard::sim
