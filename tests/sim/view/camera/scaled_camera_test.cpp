#include "sim/view/camera/camera.h"

#include <gtest/gtest.h>

#include "tests/support/kind_named.h"

namespace vegard::sim::scaled_camera_test {
namespace {

Camera tilted(const char* model) {
  Camera camera;
  camera.model = tests::kind_named<LensModel>(model);
  camera.width = 1280;
  camera.height = 853;
  camera.hfov_deg = 71.0;
  camera.focal_px = 700.0;
  camera.azimuth_deg = 338.0;
  camera.elevation_deg = 24.0;
  camera.roll_deg = 7.0;
  camera.principal_x_px = 13.0;
  camera.principal_y_px = -22.0;
  camera.aspect = 1.1;
  camera.k1 = -0.03;
  camera.k2 = 0.004;
  camera.p1 = 0.002;
  camera.p2 = -0.001;
  return camera;
}

TEST(ScaledCamera, KeepsThePlaceOfEveryDirection) {
  for (const char* model : {"pinhole", "equidistant", "equisolid", "stereographic", "polynomial"}) {
    const Camera whole = tilted(model);
    for (const PictureSize size : {PictureSize{640, 427}, PictureSize{320, 360}, PictureSize{1281, 100}}) {
      const CameraView<double> large = camera_view(whole), small = camera_view(scaled_camera(whole, size));
      for (const double x : {0.5, 300.0, 640.0, 1279.5})
        for (const double y : {0.5, 426.0, 852.5}) {
          double enu[3], at_x = 0.0, at_y = 0.0;
          ASSERT_TRUE(enu_of_pixel(large, x, y, enu)) << model;
          ASSERT_TRUE(pixel_of_enu(small, enu, at_x, at_y)) << model;
          // Ten digits of a pixel: what unprojecting a distorted lens by iteration leaves.
          EXPECT_NEAR(at_x, x * size.width / whole.width, 1e-7) << model;
          EXPECT_NEAR(at_y, y * size.height / whole.height, 1e-7) << model;
        }
    }
  }
}

TEST(ScaledCamera, FitsIntoASizeInItsOwnShape) {
  Camera camera;
  camera.width = 1280;
  camera.height = 720;
  PictureSize size = size_within(camera, {640, 360});
  EXPECT_EQ(size.width, 640);
  EXPECT_EQ(size.height, 360);
  camera.height = 853;
  size = size_within(camera, {640, 360});
  EXPECT_EQ(size.width, 540);
  EXPECT_EQ(size.height, 360);
  camera.width = 100;
  camera.height = 2000;
  size = size_within(camera, {640, 10});
  EXPECT_EQ(size.width, 1) << "at least a pixel";
  EXPECT_EQ(size.height, 10);
  size = size_within(camera, {4000, 4000});
  EXPECT_EQ(size.width, 100) << "never larger";
  EXPECT_EQ(size.height, 2000);
}

}  // namespace
}  // namespace vegard::sim::scaled_camera_test
