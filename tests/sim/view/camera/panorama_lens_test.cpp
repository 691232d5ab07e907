// The two lenses that hold every direction: a map by longitude and latitude, and the faces of a cube.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/random.h"
#include "sim/view/camera/camera.h"
#include "sim/view/camera/cube_map.h"

namespace vegard::sim::panorama_lens_test {
namespace {

Camera equirectangular(int height) {
  Camera camera;
  camera.model = LensModel::equirectangular;
  camera.width = 2 * height;
  camera.height = height;
  camera.azimuth_deg = 25.0;
  camera.elevation_deg = 0.0;
  return camera;
}

Camera cube(CubeLayout layout, int face) {
  Camera camera;
  camera.model = LensModel::cube;
  camera.cube_layout = layout;
  camera.width = cube_size(layout).columns * face;
  camera.height = cube_size(layout).rows * face;
  camera.azimuth_deg = 130.0;
  camera.elevation_deg = 22.0;
  camera.roll_deg = -15.0;
  return camera;
}

void expect_direction(const Camera& camera, double x, double y, double azimuth_deg, double elevation_deg) {
  const Direction at = direction_of_pixel(camera, x, y);
  EXPECT_NEAR(std::remainder(at.azimuth_deg - azimuth_deg, 360.0), 0.0, 1e-9) << x << ' ' << y;
  EXPECT_NEAR(at.elevation_deg, elevation_deg, 1e-9) << x << ' ' << y;
}

TEST(Equirectangular, IsALinearMapOfAzimuthAndElevation) {
  const Camera camera = equirectangular(180);  // a degree to a pixel
  expect_direction(camera, 180.0, 90.0, 25.0, 0.0);
  expect_direction(camera, 270.0, 60.0, 115.0, 30.0);
  expect_direction(camera, 10.0, 135.0, 25.0 - 170.0, -45.0);
  EXPECT_DOUBLE_EQ(pixels_per_degree(camera), 1.0);
  // Beyond the right edge the left one follows, beyond the upper one what is behind the zenith.
  expect_direction(camera, 365.0, 60.0, direction_of_pixel(camera, 5.0, 60.0).azimuth_deg, 30.0);
  expect_direction(camera, 200.0, -20.0, 25.0 + 20.0 + 180.0, 70.0);
  // Both poles are drawn, in the middle.
  const CameraView<double> view = camera_view(camera);
  const double zenith[3] = {0.0, 0.0, 2.0}, nadir[3] = {0.0, 0.0, -2.0};
  double x = 0.0, y = 0.0;
  ASSERT_TRUE(pixel_of_enu(view, zenith, x, y));
  EXPECT_NEAR(y, 0.0, 1e-9);
  ASSERT_TRUE(pixel_of_enu(view, nadir, x, y));
  EXPECT_NEAR(y, 180.0, 1e-9);
}

class EveryPanorama : public testing::TestWithParam<int> {
 protected:
  static Camera camera() {
    switch (GetParam()) {
      case 0: {
        Camera tilted = equirectangular(96);
        tilted.elevation_deg = 40.0;
        tilted.roll_deg = 12.0;
        return tilted;
      }
      case 1:
        return cube(CubeLayout::cross, 40);
      case 2:
        return cube(CubeLayout::strip, 40);
      default:
        return cube(CubeLayout::grid, 40);
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Kind, EveryPanorama, testing::Range(0, 4));

TEST_P(EveryPanorama, DrawsEveryDirectionOnce) {
  const Camera one = camera();
  const CameraView<double> view = camera_view(one);
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const Words words = random_words(20140221, Stream::stars, i);
    const double up = 2.0 * uniform(words[0]) - 1.0, turn = kTwoPi * uniform(words[1]);
    const double enu[3] = {std::sqrt(1.0 - up * up) * std::cos(turn),
                           std::sqrt(1.0 - up * up) * std::sin(turn), up};
    double x = 0.0, y = 0.0, back[3];
    ASSERT_TRUE(pixel_of_enu(view, enu, x, y));
    EXPECT_TRUE(x >= 0.0 && x <= one.width && y >= 0.0 && y <= one.height) << x << ' ' << y;
    ASSERT_TRUE(enu_of_pixel(view, x, y, back));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(back[k], enu[k], 1e-12);
  }
}

// The midpoint rule over some thousand pixels: 1e-3 of each.
TEST_P(EveryPanorama, ItsPixelsAreTheWholeSphere) {
  const Camera one = camera();
  const CameraView<double> view = camera_view(one);
  double steradians = 0.0;
  for (int y = 0; y < one.height; ++y)
    for (int x = 0; x < one.width; ++x) steradians += pixel_steradians(view.lens, x + 0.5, y + 0.5);
  EXPECT_NEAR(steradians / (4.0 * kPi), 1.0, 1e-3);
}

TEST_P(EveryPanorama, ItsFacesArePinholes) {
  const Camera one = camera();
  if (one.model != LensModel::cube) return;
  const CameraView<double> view = camera_view(one);
  for (const CubeFace& face : cube_faces(one.cube_layout)) {
    const CameraView<double> pinhole = camera_view(camera_of_face(one, face));
    for (double y = 0.5; y < face_px(one); y += 9.0)
      for (double x = 0.5; x < face_px(one); x += 9.0) {
        double of_cube[3], of_face[3];
        ASSERT_TRUE(enu_of_pixel(view, face.column * face_px(one) + x, face.row * face_px(one) + y, of_cube));
        ASSERT_TRUE(enu_of_pixel(pinhole, x, y, of_face));
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(of_cube[k], of_face[k], 1e-12);
      }
  }
}

// What is side by side in a cross is side by side in the sky.
TEST(CubeCross, JoinsAtItsSeams) {
  const Camera camera = cube(CubeLayout::cross, 100);
  const CameraView<double> view = camera_view(camera);
  const auto apart = [&](double x1, double y1, double x2, double y2) {
    double a[3], b[3], sum = 0.0;
    EXPECT_TRUE(enu_of_pixel(view, x1, y1, a) && enu_of_pixel(view, x2, y2, b));
    for (int k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return std::sqrt(sum);
  };
  constexpr double kBeside = 1e-6;
  for (const double along : {10.0, 50.0, 83.0}) {
    for (const double seam : {100.0, 200.0, 300.0})
      EXPECT_LT(apart(seam - kBeside, 100.0 + along, seam + kBeside, 100.0 + along), 1e-7);
    EXPECT_LT(apart(kBeside, 100.0 + along, 400.0 - kBeside, 100.0 + along), 1e-7);
    EXPECT_LT(apart(100.0 + along, 100.0 - kBeside, 100.0 + along, 100.0 + kBeside), 1e-7);
    EXPECT_LT(apart(100.0 + along, 200.0 - kBeside, 100.0 + along, 200.0 + kBeside), 1e-7);
  }
  double enu[3];
  EXPECT_FALSE(enu_of_pixel(view, 50.0, 50.0, enu));  // a corner of the cross
}

}  // namespace
}  // namespace vegard::sim::panorama_lens_test
