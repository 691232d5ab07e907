
#include <gtest/gtest.h>

#include <cmath>

#include "sim/view/sensor/tone_curve.h"

namespace vegard::sim::bent_srgb_test {
namespace {

const BentSrgb kCurves[] = {{1.0, 1.0}, {1.3, 1.3}, {0.25, 4.0}, {4.0, 0.25}, {0.7, 1.6}, {2.0, 1.0}};

TEST(BentSrgb, RunsFromBlackToWhiteAndComesBack) {
  for (const BentSrgb& curve : kCurves) {
    EXPECT_EQ(curve.decode(0.0), 0.0);
    EXPECT_NEAR(curve.decode(1.0), 1.0, 1e-12);
    EXPECT_EQ(curve.encode(0.0), 0.0);
    for (double v = 1.0 / 256.0; v <= 1.0; v += 1.0 / 256.0) {
      EXPECT_NEAR(curve.encode(curve.decode(v)), v, 1e-9) << curve.black << " " << curve.white;
      EXPECT_EQ(curve.decode(-v), -curve.decode(v));
    }
  }
}

TEST(BentSrgb, IncreasesEverywhere) {
  for (const BentSrgb& curve : kCurves)
    for (double v = 1e-4; v < 1.0; v += 1e-4) ASSERT_LT(curve.decode(v), curve.decode(v + 1e-4)) << v;
}

TEST(BentSrgb, WithExponentsOfOneIsSrgb) {
  for (double v = 0.0; v <= 1.0; v += 0.01) EXPECT_NEAR(BentSrgb().decode(v), srgb_decode(v), 1e-12);
}

// The slope is that of differences, and its logarithm's against sRGB's goes from the one exponent to the
// other.
TEST(BentSrgb, HasTheSlopeItClaims) {
  for (const BentSrgb& curve : kCurves)
    for (double v = 0.06; v < 1.0; v += 0.02) {
      const double h = 1e-6;
      const double difference = (curve.decode(v + h) - curve.decode(v - h)) / (2.0 * h);
      EXPECT_NEAR(curve.slope(v) / difference, 1.0, 1e-6);
      const double of_srgb = std::log(srgb_decode(v + h) / srgb_decode(v - h));
      const double exponent = std::log(curve.decode(v + h) / curve.decode(v - h)) / of_srgb;
      EXPECT_NEAR(exponent, curve.black + (curve.white - curve.black) * (v + 0.055) / 1.055, 1e-6);
    }
}

}  // namespace
}  // namespace vegard::sim::bent_srgb_test
