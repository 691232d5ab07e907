#include "sim/emit/nebula/noise_lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/emit/nebula/noise_octaves.h"

namespace vegard::sim {
namespace {

const NoiseLattice& lattice() {
  static const NoiseLattice noise(41, 5);
  return noise;
}

TEST(NoiseLattice, IsZeroAtItsNodesRepeatsAndKeepsToItsRange) {
  double most = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double x = i * 1.37 - 900.0, y = i * 0.61 + 0.23, z = i * 0.23 - 70.0;
    EXPECT_EQ(lattice().value(std::floor(x), std::floor(y), std::floor(z)), 0.0);
    const double here = lattice().value(x, y, z);
    // The same place but for the rounding of x, some 1e-13.
    EXPECT_NEAR(lattice().value(x + NoiseLattice::kPeriod, y, z - NoiseLattice::kPeriod), here, 1e-11);
    most = std::max(most, std::abs(here));
  }
  EXPECT_LT(most, NoiseLattice::kLargest);
  EXPECT_GT(most, 0.6);
  EXPECT_NE(NoiseLattice(41, 6).value(0.4, 0.3, 0.7), lattice().value(0.4, 0.3, 0.7));
}

TEST(NoiseLattice, SlopesAreThoseOfDifferences) {
  constexpr double h = 1e-5;
  for (int i = 0; i < 300; ++i) {
    const double p[3] = {i * 1.371 - 200.0, i * 0.613 + 0.2, i * 0.237 - 31.0};
    const NoiseAt at = lattice().with_slope(p[0], p[1], p[2]);
    EXPECT_EQ(at.value, lattice().value(p[0], p[1], p[2]));
    for (int axis = 0; axis < 3; ++axis) {
      double more[3] = {p[0], p[1], p[2]}, less[3] = {p[0], p[1], p[2]};
      more[axis] += h;
      less[axis] -= h;
      const double difference =
          (lattice().value(more[0], more[1], more[2]) - lattice().value(less[0], less[1], less[2])) /
          (2.0 * h);
      // h² times a sixth of the third derivative, which is below 200, and rounding over h.
      EXPECT_NEAR(at.slope[axis], difference, 2e-8);
    }
  }
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
}  // namespace vegard::sim
