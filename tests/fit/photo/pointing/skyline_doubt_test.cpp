#include "fit/photo/pointing/skyline_doubt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fit/photo/pointing/catalogue_sky.h"
#include "sim/base/number/random.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit::skyline_doubt_test {
namespace {

constexpr int kWidth = 900, kHeight = 600;

sim::Camera camera_with_a_horizon() {
  sim::Camera camera;
  camera.width = kWidth, camera.height = kHeight;
  camera.hfov_deg = 70.0, camera.azimuth_deg = 0.0, camera.elevation_deg = 25.0;
  return camera;
}

/// Sky with some noise, and the stars of the catalogue where the line or anything else does not hide them.
Photo sky_with_stars(const sim::Camera& camera, const SkyOfPicture& sky, double lowest_star_y_px) {
  Photo photo;
  photo.linear = sim::Image(kWidth, kHeight, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const sim::Words w = sim::random_words(7, sim::Stream::photon_noise, static_cast<std::uint32_t>(x),
                                             static_cast<std::uint32_t>(y));
      for (int c = 0; c < 3; ++c) photo.linear.at(x, y, c) = 0.05f + 0.002f * (sim::uniform(w[0]) - 0.5f);
    }
  const sim::CameraView<double> view = sim::camera_view(camera);
  for (const StarSighting& star : catalogue_sky(*sky.observer, *sky.julian_date, 4.0, 1.0)) {
    double x = 0.0, y = 0.0;
    if (!sim::pixel_of_enu(view, star.enu.data(), x, y) || y > lowest_star_y_px) continue;
    for (int j = -4; j <= 4; ++j)
      for (int i = -4; i <= 4; ++i) {
        const int column = static_cast<int>(x) + i, row = static_cast<int>(y) + j;
        if (column < 0 || row < 0 || column >= kWidth || row >= kHeight) continue;
        const double d2 = std::pow(column + 0.5 - x, 2) + std::pow(row + 0.5 - y, 2);
        for (int c = 0; c < 3; ++c)
          photo.linear.at(column, row, c) += static_cast<float>(0.3 * std::exp(-0.5 * d2 / 1.44));
      }
  }
  return photo;
}

/// A line so many pixels below the picture's upper edge, up and down by `rough_px` from column to column.
std::vector<PixelPoint> skyline_at(double y_px, double rough_px) {
  std::vector<PixelPoint> points;
  for (int x = 0; x < kWidth; ++x) {
    const sim::Words w =
        sim::random_words(3, sim::Stream::photon_noise, static_cast<std::uint32_t>(x / 3), 0u);
    points.push_back({x + 0.5, y_px + rough_px * (sim::uniform(w[0]) - 0.5)});
  }
  return points;
}

SkyOfPicture winter_night() {
  return {*sim::julian_date("2020-12-22T00:00:00Z"), sim::Observer{60.0, 20.0, 0.0, true}};
}

// The horizon is some 300 px below the middle of this picture's height: 350 px down are 20 degrees up.
TEST(SkylineDoubt, StarsBelowALineSayThatItIsNoGround) {
  const sim::Camera camera = camera_with_a_horizon();
  const SkyOfPicture sky = winter_night();
  // As rough as trees, but stars shine through them.
  const auto doubt =
      skyline_doubt(skyline_at(350.0, 30.0), camera, sky_with_stars(camera, sky, kHeight), sky);
  ASSERT_TRUE(doubt.has_value());
  EXPECT_TRUE(doubt->has_stars());
  EXPECT_LT(doubt->by_chance, 1.0);
  EXPECT_GT(doubt->from_deg, 10.0);
  // The same without a star below it: trees.
  EXPECT_FALSE(
      skyline_doubt(skyline_at(350.0, 30.0), camera, sky_with_stars(camera, sky, 320.0), sky).has_value());
}

TEST(SkylineDoubt, ASmoothLineIsDoubtedOnlyHighAboveTheHorizon) {
  const sim::Camera camera = camera_with_a_horizon();
  const SkyOfPicture sky = winter_night();
  const Photo photo = sky_with_stars(camera, sky, 320.0);
  const auto doubt = skyline_doubt(skyline_at(350.0, 0.0), camera, photo, sky);
  ASSERT_TRUE(doubt.has_value());
  EXPECT_FALSE(doubt->has_stars());
  EXPECT_GT(doubt->azimuths_deg, 60.0);
  // At the horizon, and where the picture ends.
  EXPECT_FALSE(skyline_doubt(skyline_at(560.0, 0.0), camera, photo, sky).has_value());
  EXPECT_FALSE(skyline_doubt(skyline_at(kHeight, 0.0), camera, photo, sky).has_value());
  // Without time and site the line alone is judged.
  EXPECT_TRUE(skyline_doubt(skyline_at(350.0, 0.0), camera, photo, {}).has_value());
  EXPECT_FALSE(skyline_doubt(skyline_at(350.0, 30.0), camera, photo, {}).has_value());
}

}  // namespace
}  // namespace vegard::fit::skyline_doubt_test
