
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/number/noise.h"

namespace vegard::sim::noise_lattice_test {
namespace {

const NoiseLattice& lattice() {
  static const NoiseLattice noise(41, Stream::nebula, 5);
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
  EXPECT_NE(NoiseLattice(41, Stream::nebula, 6).value(0.4, 0.3, 0.7), lattice().value(0.4, 0.3, 0.7));
  EXPECT_NE(NoiseLattice(41, Stream::chromosphere, 5).value(0.4, 0.3, 0.7), lattice().value(0.4, 0.3, 0.7));
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

}  // namespace
}  // namespace vegard::sim::noise_lattice_test
