
#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/distributions.h"

namespace vegard::sim::normal_quantile_test {
namespace {

TEST(NormalQuantile, HasTheTabulatedValues) {
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1.2e-9 * 2);
  EXPECT_NEAR(normal_quantile(0.995), 2.575829303548901, 1.2e-9 * 3);
  EXPECT_NEAR(normal_quantile(0.8413447460685429), 1.0, 1.2e-9);
  EXPECT_EQ(normal_quantile(0.5), 0.0);
}

TEST(NormalQuantile, InvertsTheDistributionFunctionToItsStatedError) {
  for (double p = 1e-9; p < 1.0; p += p < 0.02 ? 0.3 * p : 0.0037) {
    const double x = normal_quantile(p);
    const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::acos(-1.0));
    EXPECT_NEAR(0.5 * std::erfc(-x / std::sqrt(2.0)), p, 1.2e-9 * std::abs(x) * density + 1e-15) << p;
  }
}

TEST(NormalQuantile, IsOddAboutOneHalf) {
  for (double p : {0.001, 0.02, 0.03, 0.2, 0.49}) {
    EXPECT_NEAR(normal_quantile(p), -normal_quantile(1.0 - p), 1e-12);
  }
}

}  // namespace
}  // namespace vegard::sim::normal_quantile_test
