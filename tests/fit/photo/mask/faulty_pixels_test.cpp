#include "fit/photo/mask/faulty_pixels.h"

#include <gtest/gtest.h>

#include "tests/support/made_sky.h"

namespace vegard::fit::hot_pixels_test {
namespace {

constexpr double kNoise = 0.004;

/// Seed 11. Forty hot and forty dead pixels, of one channel each, at 15 σ of a pixel's noise; the difference
/// to the median of eight scatters by about 1.1 of it, so that they stand at 13.6 ± 1 of the finder's σ.
TEST(HotPixels, FindsThemAllAndNothingElse) {
  Photo photo = tests::even_sky(300, 200, 0.2f);
  tests::add_noise(photo, kNoise, 11);
  PixelSet placed(300, 200);
  for (int i = 0; i < 80; ++i) {
    const int x = 12 + 28 * (i % 10), y = 9 + 23 * (i / 10);
    photo.linear.at(x, y, i % 3) += static_cast<float>((i % 2 ? -15.0 : 15.0) * kNoise);
    placed.at(x, y) = 1;
  }
  EXPECT_EQ(hot_pixels(photo).in, placed.in);
}

/// Seed 12. Stars of 1.6 pixels, on a pixel's centre, where they are narrowest, and off it.
TEST(HotPixels, LeavesStarsAlone) {
  Photo photo = tests::even_sky(300, 200, 0.2f);
  tests::add_noise(photo, kNoise, 12);
  for (int i = 0; i < 60; ++i)
    tests::add_star(photo, 15.5 + 29 * (i % 10) + 0.1 * (i % 6), 14.5 + 30 * (i / 10), 1.6, 0.05 + 0.01 * i);
  EXPECT_EQ(hot_pixels(photo).count(), 0u);
}

/// The edge of a dark ground with single-pixel teeth, noiseless: what stands out there is no pixel's fault.
TEST(HotPixels, LeavesEdgesAlone) {
  Photo photo = tests::even_sky(200, 120, 0.3f);
  for (int y = 60; y < 120; ++y)
    for (int x = 0; x < 200; ++x)
      for (int c = 0; c < 3; ++c) photo.linear.at(x, y, c) = y == 60 && x % 2 ? 0.3f : 0.01f;
  EXPECT_EQ(hot_pixels(photo).count(), 0u);
}

}  // namespace
}  // namespace vegard::fit::hot_pixels_test
