#include "sim/emit/nebula/noise_octaves.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vegard::sim::noise_octaves_test {
namespace {

const NoiseLattice& lattice() {
  static const NoiseLattice noise(41, Stream::nebula, 5);
  return noise;
}

TEST(NoiseOctaves, RidgesGoFromZeroToOneAndStopEarlyOnlyBelow) {
  const NoiseNumbers<double> noise{2.0, 0.6, 5};
  double least = 1.0, most = 0.0;
  int stopped = 0;
  for (int i = 0; i < 5000; ++i) {
    const double p[3] = {i * 0.137, i * 0.061, i * 0.023};
    const double ridge = ridges_of(lattice(), noise, p), early = ridges_of(lattice(), noise, p, 0.4);
    least = std::min(least, ridge);
    most = std::max(most, ridge);
    if (early == ridge) continue;
    ++stopped;
    EXPECT_LT(ridge, 0.4);
    EXPECT_LE(early, 0.4);
  }
  EXPECT_GE(least, 0.0);
  EXPECT_LE(most, 1.0);
  EXPECT_GT(most, 0.5);
  EXPECT_GT(stopped, 500);
}

TEST(NoiseOctaves, OneOctaveIsTheNoiseItself) {
  const double p[3] = {0.3, 0.7, -0.2};
  EXPECT_EQ(octaves_of(lattice(), NoiseNumbers<double>{2.0, 0.5, 1}, p), lattice().value(0.6, 1.4, -0.4));
}

}  // namespace
}  // namespace vegard::sim::noise_octaves_test
