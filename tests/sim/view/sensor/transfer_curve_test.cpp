#include "sim/view/sensor/tone_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vegard::sim::transfer_curve_test {
namespace {

TEST(TransferCurve, AgreesWithTheStandard) {
  // IEC 61966-2-1: the ends, the knee, and the middle grey of 18 % and code 128 as commonly tabulated.
  EXPECT_DOUBLE_EQ(srgb_encode(0.0), 0.0);
  EXPECT_NEAR(srgb_encode(1.0), 1.0, 1e-15);
  EXPECT_NEAR(srgb_encode(0.001), 0.01292, 1e-15);
  EXPECT_NEAR(srgb_encode(0.0031308), 0.04045, 1e-6);
  EXPECT_NEAR(srgb_encode(0.18), 0.461356, 1e-6);
  EXPECT_NEAR(srgb_decode(128.0 / 255.0), 0.215861, 1e-6);
}

TEST(TransferCurve, DecodingUndoesEncoding) {
  for (int i = -12288; i <= 12288; ++i) {
    const double linear = i / 8192.0;
    EXPECT_NEAR(srgb_decode(srgb_encode(linear)), linear, 1e-7);
    EXPECT_NEAR(srgb_encode(srgb_decode(linear)), linear, 1e-7);
  }
}

TEST(TransferCurve, RisesThroughTheKnee) {
  double last = srgb_encode(0.0030);
  for (int i = 0; i < 30000; ++i) {
    const double linear = 0.0030 + 1e-8 * i;
    const double encoded = srgb_encode(linear);
    EXPECT_GE(encoded, last);
    EXPECT_LT(encoded - last, 1e-6) << "a step at " << linear;
    last = encoded;
  }
}

TEST(TransferCurve, PassesNotANumberOn) {
  EXPECT_TRUE(std::isnan(srgb_encode(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(std::isnan(srgb_decode(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace vegard::sim::transfer_curve_test
