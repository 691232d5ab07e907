#include "fit/measure/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fit/model/profile_model.h"

namespace vegard::fit::smoothing_test {
namespace {

constexpr int kBands = 2, kRows = 60;

Profile ramp() {
  Profile p;
  p.bands = kBands;
  p.rows = kRows;
  for (int b = 0; b < kBands; ++b)
    for (int r = 0; r < kRows; ++r)
      for (int c = 0; c < 3; ++c) {
        p.mean.push_back(b + 0.1 * r + c);
        p.standard_error.push_back(0.5);
        p.count.push_back(10);
      }
  return p;
}

TEST(Smoothed, KeepsAStraightLineAwayFromTheEndsAndBridgesGaps) {
  Profile p = ramp();
  const std::size_t gap = p.index(1, 30, 2);
  p.count[gap] = 0;
  p.mean[gap] = std::numeric_limits<double>::quiet_NaN();
  const Profile s = smoothed(p, 3.0);
  EXPECT_NEAR(s.mean[s.index(0, 30, 0)], 3.0, 1e-6);
  EXPECT_TRUE(std::isfinite(s.mean[gap]));
  EXPECT_GT(s.count[gap], 0);
  // Independent rows: the variance falls by the sum of the squared weights, 1 / (2 sqrt(pi) sigma).
  EXPECT_NEAR(s.standard_error[s.index(0, 30, 0)],
              0.5 * std::sqrt(1.0 / (2.0 * std::sqrt(std::acos(-1.0)) * 3.0)), 0.005);
}

TEST(Smooth, TreatsModelsAndTheirDerivativesAsProfiles) {
  const Profile p = ramp();
  ModelProfile m;
  m.value = p.mean;
  m.free = 2;
  for (double v : p.mean) {
    m.derivative.push_back(v);
    m.derivative.push_back(-3.0 * v);
  }
  smooth(m, kBands, kRows, 2.5);
  const Profile s = smoothed(p, 2.5);
  for (std::size_t i = 0; i < s.mean.size(); ++i) {
    EXPECT_NEAR(m.value[i], s.mean[i], 1e-12);
    EXPECT_NEAR(m.derivative[2 * i], s.mean[i], 1e-12);
    EXPECT_NEAR(m.derivative[2 * i + 1], -3.0 * s.mean[i], 1e-12);
  }
}

}  // namespace
}  // namespace vegard::fit::smoothing_test
