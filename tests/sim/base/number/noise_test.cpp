#include "sim/base/number/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vegard::sim::noise_test {
namespace {

constexpr std::uint64_t kSeed = 41;

double noise(double x, double y, double z, std::uint64_t address = 5) {
  return gradient_noise(kSeed, Stream::border, address, x, y, z);
}

TEST(GradientNoise, IsZeroAtTheNodesAndOnlyThere) {
  double between = 0.0;
  for (int i = -3; i < 4; ++i)
    for (int j = -3; j < 4; ++j) {
      EXPECT_EQ(noise(i, j, 2 * i - j), 0.0);
      between = std::max(between, std::abs(noise(i + 0.5, j + 0.5, 0.5)));
    }
  EXPECT_GT(between, 0.3);
}

TEST(GradientNoise, AndItsSlopeAreContinuousAcrossNodes) {
  constexpr double h = 1e-4;
  for (int i = -2; i < 3; ++i) {
    const auto at = [&](double x) { return noise(x, 0.3 + i, 0.7); };
    EXPECT_NEAR(at(i - 1e-9), at(i + 1e-9), 1e-8);
    const double left = (at(i) - at(i - h)) / h, right = (at(i + h) - at(i)) / h;
    // Of a continuous slope these differ by h times the curvature, which is below 60 for slopes below 2.
    EXPECT_NEAR(left, right, 60.0 * h);
  }
}

TEST(GradientNoise, KeepsToItsRangeAndHasNoMean) {
  double least = 0.0, most = 0.0, sum = 0.0;
  int n = 0;
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 60; ++j)
      for (int k = 0; k < 10; ++k, ++n) {
        const double v = noise(i * 1.37 + 0.11, j * 1.61 + 0.23, k * 1.23 + 0.37);
        least = std::min(least, v);
        most = std::max(most, v);
        sum += v;
      }
  // The gradients are sqrt(2) long and the farthest corner is sqrt(3)/2 away, but the weights hold it
  // to 1.04.
  EXPECT_GT(least, -1.04);
  EXPECT_LT(most, 1.04);
  EXPECT_LT(least, -0.6);
  EXPECT_GT(most, 0.6);
  // Its standard deviation is about 0.26: four standard errors of 36000 points are 0.006. Seed 41.
  EXPECT_NEAR(sum / n, 0.0, 0.006);
}

TEST(GradientNoise, NeighboursAreAlikeAndDistantPointsAreNot) {
  double near = 0.0, far = 0.0, other = 0.0, square = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double x = i * 3.71 + 0.17, y = i * 0.77 + 0.29, z = i * 0.13 + 0.41;
    const double here = noise(x, y, z);
    square += here * here;
    near += here * noise(x + 0.1, y, z);
    far += here * noise(x + 2.0, y, z);
    other += here * noise(x, y, z, 6);
  }
  EXPECT_GT(near / square, 0.9);
  // Five standard errors of the correlation of 20000 pairs. Seed 41.
  EXPECT_NEAR(far / square, 0.0, 0.035);
  EXPECT_NEAR(other / square, 0.0, 0.035);
}

TEST(OctaveNoise, AddsWavesOfHalfTheLengthAndHalfTheHeight) {
  const auto octaves = [](int n, double x) { return octave_noise(kSeed, Stream::border, 5, n, x, 0.3, 0.6); };
  double square[3] = {};
  for (int i = 0; i < 20000; ++i) {
    const double x = i * 1.73 + 0.11;
    double before = 0.0;
    for (int n = 1; n <= 3; ++n) {
      const double now = octaves(n, x);
      square[n - 1] += (now - before) * (now - before);
      before = now;
    }
  }
  // Along a line the noise's mean square depends on where it cuts the lattice, by tens of per cent.
  EXPECT_NEAR(std::sqrt(square[1] / square[0]), 0.5, 0.15);
  EXPECT_NEAR(std::sqrt(square[2] / square[0]), 0.25, 0.08);
  // The second octave is 0 at its nodes, twice as dense.
  EXPECT_NE(octaves(1, 0.5), 0.0);
  EXPECT_EQ(octave_noise(kSeed, Stream::border, 5, 2, 0.5, 1.5, 2.0),
            octave_noise(kSeed, Stream::border, 5, 1, 0.5, 1.5, 2.0));
}

}  // namespace
}  // namespace vegard::sim::noise_test
