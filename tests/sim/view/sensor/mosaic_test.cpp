#include "sim/view/sensor/sensor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::mosaic_test {
namespace {

constexpr MosaicPattern kPatterns[] = {MosaicPattern::rggb, MosaicPattern::bggr, MosaicPattern::grbg,
                                       MosaicPattern::gbrg};

/// What stands behind the filters of a picture of three channels.
Image mosaic_of(const Image& rgb, MosaicPattern pattern) {
  Image mosaic(rgb.width, rgb.height, {"raw"});
  for (int y = 0; y < rgb.height; ++y)
    for (int x = 0; x < rgb.width; ++x) mosaic.at(x, y, 0) = rgb.at(x, y, filter_of_pixel(pattern, x, y));
  return mosaic;
}

TEST(Mosaic, HasHalfItsPixelsGreen) {
  for (const MosaicPattern pattern : kPatterns) {
    int count[3] = {0, 0, 0};
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) ++count[filter_of_pixel(pattern, x, y)];
    EXPECT_EQ(count[0], 4);
    EXPECT_EQ(count[1], 8);
    EXPECT_EQ(count[2], 4);
  }
  EXPECT_EQ(filter_of_pixel(MosaicPattern::rggb, 0, 0), 0);
  EXPECT_EQ(filter_of_pixel(MosaicPattern::gbrg, 0, 1), 0);
  EXPECT_EQ(filter_of_pixel(MosaicPattern::grbg, 2, 3), 2);
}

// Light that rises evenly is found again exactly, but for the outermost pixels, which have no neighbours on
// one side.
TEST(Mosaic, FindsEvenSlopesAgain) {
  Image rgb(9, 7, {"R", "G", "B"});
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 9; ++x)
      for (int c = 0; c < 3; ++c) rgb.at(x, y, c) = static_cast<float>(c + 2 * x - 3 * y * (c + 1));
  for (const MosaicPattern pattern : kPatterns) {
    const Image found = demosaic(mosaic_of(rgb, pattern), pattern);
    for (int y = 1; y < 6; ++y)
      for (int x = 1; x < 8; ++x)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found.at(x, y, c), rgb.at(x, y, c), 1e-5);
  }
}

// Of independent pixels with variance 1: a mean of n has 1 / n.
TEST(Mosaic, VariancesAreThoseOfMeans) {
  Image ones(6, 6, {"raw"});
  for (float& value : ones.data) value = 1.0f;
  const Image variance = demosaic_variance(ones, MosaicPattern::rggb);
  EXPECT_FLOAT_EQ(variance.at(2, 2, 0), 1.0f);   // red at a red pixel
  EXPECT_FLOAT_EQ(variance.at(3, 2, 0), 0.5f);   // between two
  EXPECT_FLOAT_EQ(variance.at(3, 3, 0), 0.25f);  // between four
  EXPECT_FLOAT_EQ(variance.at(2, 2, 1), 0.25f);
  EXPECT_FLOAT_EQ(variance.at(0, 0, 1), 0.5f);  // in the corner two are left
  EXPECT_FLOAT_EQ(variance.at(0, 0, 2), 1.0f);
}

}  // namespace
}  // namespace vegard::sim::mosaic_test
