#include "sim/base/number/escaping_share.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::escaping_share_test {
namespace {

/// (1 - exp(-x)) / x is the mean of exp(-x s) for s from 0 to 1, its slope that of -s exp(-x s). Simpson's
/// rule with 2000 intervals is good to (x / 2000)^4 / 180.
void by_quadrature(double x, double& share, double& slope) {
  constexpr int kIntervals = 2000;
  share = slope = 0.0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double s = static_cast<double>(i) / kIntervals;
    const double weight = (i == 0 || i == kIntervals ? 1.0 : i % 2 ? 4.0 : 2.0) / (3.0 * kIntervals);
    share += weight * std::exp(-x * s);
    slope -= weight * s * std::exp(-x * s);
  }
}

TEST(EscapingShare, IsTheMeanOfWhatIsLetThroughForEitherSign) {
  for (const double x : {-30.0, -3.0, -0.0101, -0.0099, -1e-6, 0.0, 1e-6, 0.0099, 0.0101, 0.7, 30.0}) {
    double share, slope, mean, mean_slope;
    sim::escaping_share(x, share, slope);
    by_quadrature(x, mean, mean_slope);
    // Differences of numbers near 1 over x lose 16 digits over x, of the slope over x squared.
    EXPECT_NEAR(share / mean, 1.0, 1e-9) << x;
    EXPECT_NEAR(slope / mean_slope, 1.0, 1e-9) << x;
  }
}

TEST(EscapingShare, ADualHasTheSlope) {
  using OneDual = sim::Dual<double, sim::Tangents<double, 1>>;
  for (const double x : {-2.0, 1e-4, 2.0}) {
    OneDual dual(x);
    dual.d.t[0] = 3.0;
    double share, slope;
    sim::escaping_share(x, share, slope);
    EXPECT_EQ(sim::escaping_share(dual).v, sim::escaping_share(x));
    EXPECT_EQ(sim::escaping_share(dual).d.t[0], 3.0 * slope);
  }
}

}  // namespace
}  // namespace vegard::escaping_share_test
