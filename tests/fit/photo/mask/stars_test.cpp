#include "fit/photo/mask/stars.h"

#include <gtest/gtest.h>

#include "fit/photo/mask/pixel_set.h"
#include "tests/support/made_sky.h"

namespace vegard::fit::stars_test {
namespace {

constexpr double kNoise = 0.004;

/// Seed 21. At five σ one of ten such skies of 345 600 pixels would have a false star, were they independent
/// (the smoothing leaves fewer that are).
TEST(Stars, NoneInNoiseNorInAGradient) {
  Photo photo = tests::even_sky(720, 480, 0.1f);
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 720; ++x)
      for (int c = 0; c < 3; ++c) photo.linear.at(x, y, c) += static_cast<float>(0.0005 * y);
  tests::add_noise(photo, kNoise, 21);
  EXPECT_TRUE(find_stars(photo).stars.empty());
}

/// Seed 22. Sixty stars of 1.5 to 4 pixels, brighter than 15 σ of a pixel's noise.
TEST(Stars, FindsThemAllWhereTheyAreAndCoversTheirLight) {
  Photo photo = tests::even_sky(600, 400, 0.2f), stars_alone = tests::even_sky(600, 400, 0.0f);
  std::vector<PicturePoint> placed;
  for (int i = 0; i < 60; ++i) {
    const double x = 30.0 + 58.0 * (i % 10) + 0.37 * (i % 7), y = 31.0 + 63.0 * (i / 10) + 0.29 * (i % 5);
    const double fwhm = 1.5 + 0.25 * (i % 11), peak = 0.06 * (1 + i % 4);
    tests::add_star(photo, x, y, fwhm, peak);
    tests::add_star(stars_alone, x, y, fwhm, peak);
    placed.push_back({x, y});
  }
  tests::add_noise(photo, kNoise, 22);
  const StarsFound found = find_stars(photo);
  ASSERT_EQ(found.stars.size(), placed.size());
  for (const PicturePoint& place : placed) {
    double nearest = 1e9;
    for (const Star& star : found.stars)
      nearest = std::min(nearest, std::hypot(star.x_px - place.x_px, star.y_px - place.y_px));
    // Of pixels above half the peak only, with the noise of a 15 σ star: a few tenths.
    EXPECT_LT(nearest, 0.4);
  }
  // What is left of a star outside its disc is below the noise of a pixel of three channels' mean, 0.58 σ.
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 600; ++x)
      if (!found.covered.at(x, y)) {
        ASSERT_LT(stars_alone.linear.at(x, y, 1), 0.58 * kNoise) << x << " " << y;
      }
}

/// Seed 23. Rays of all directions, three to twelve pixels wide and up to 60 σ bright.
TEST(Stars, LeavesRaysAlone) {
  Photo photo = tests::even_sky(720, 480, 0.2f);
  for (int i = 0; i < 16; ++i)
    tests::add_ray(photo, 40.0 + 44.0 * i, 320.0, 180.0, -0.6 + 0.08 * i, 3.0 + 0.6 * i, 0.08 + 0.01 * i);
  tests::add_noise(photo, kNoise, 23);
  EXPECT_EQ(find_stars(photo).covered.count(), 0u);
}

/// Seed 24. The same on a ray.
TEST(Stars, FindsAStarInFrontOfARay) {
  Photo photo = tests::even_sky(200, 200, 0.2f);
  tests::add_ray(photo, 100.0, 190.0, 180.0, 0.1, 12.0, 0.2);
  tests::add_star(photo, 110.3, 100.8, 2.5, 0.15);
  tests::add_noise(photo, kNoise, 24);
  const StarsFound found = find_stars(photo);
  ASSERT_EQ(found.stars.size(), 1u);
  EXPECT_NEAR(found.stars[0].x_px, 110.3, 0.5);
  EXPECT_NEAR(found.stars[0].y_px, 100.8, 0.5);
}

/// Seed 25. A picture of 4000 pixels is binned by two: a star of eight pixels has its place all the same.
TEST(Stars, FindsLargeStarsOfLargePictures) {
  Photo photo = tests::even_sky(4000, 120, 0.2f);
  tests::add_star(photo, 1501.0, 61.0, 8.0, 0.2);
  tests::add_noise(photo, kNoise, 25);
  const StarsFound found = find_stars(photo);
  EXPECT_EQ(found.size_px, 20);
  ASSERT_EQ(found.stars.size(), 1u);
  EXPECT_NEAR(found.stars[0].x_px, 1501.0, 1.0);
  EXPECT_NEAR(found.stars[0].y_px, 61.0, 1.0);
}

}  // namespace
}  // namespace vegard::fit::stars_test
