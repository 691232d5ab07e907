// Means over a normal distribution.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/number/gauss_quadrature.h"

namespace vegard::sim::gauss_hermite_test {
namespace {

/// The mean of x^2m is (2m - 1)!!, that of odd powers 0; exact up to the degree 2 count - 1.
TEST(NormalNodes, HaveTheMomentsOfANormalDistribution) {
  for (int count = 1; count <= 16; ++count) {
    const std::vector<NormalNode> nodes = normal_nodes(count);
    ASSERT_EQ(nodes.size(), static_cast<std::size_t>(count));
    double factorial = 1.0;
    for (int power = 0; power < 2 * count; ++power) {
      double mean = 0.0, size = 0.0;
      for (const NormalNode& node : nodes) {
        const double term = node.weight * std::pow(node.place, power);
        mean += term;
        size += std::abs(term);
      }
      if (power > 0 && power % 2 == 0) factorial *= power - 1;
      EXPECT_NEAR(mean, power % 2 == 0 ? factorial : 0.0, 1e-10 * std::max(size, 1.0)) << count << " nodes, power " << power;
    }
  }
}

/// M. Abramowitz and I. A. Stegun, "Handbook of mathematical functions", 1964, table 25.10, n = 3, for the
/// weight exp(-x²): zeros ±1.224744871, weights 1.181635901 and 0.295408975.
TEST(NormalNodes, AreThoseOfTheHandbook) {
  const std::vector<NormalNode> nodes = normal_nodes(3);
  EXPECT_NEAR(nodes[2].place, 1.224744871 * std::sqrt(2.0), 1e-8);
  EXPECT_NEAR(nodes[1].weight, 1.181635901 / std::sqrt(3.14159265358979), 1e-8);
  EXPECT_NEAR(nodes[0].weight, 0.295408975 / std::sqrt(3.14159265358979), 1e-8);
}

}  // namespace
}  // namespace vegard::sim::gauss_hermite_test
