#include "sim/view/camera/camera.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace vegard::sim::camera_test {
namespace {

constexpr double kDegree = kRadiansPerDegree;

/// Where a direction appears, in pixels.
std::array<double, 2> pixel_of(const Camera& camera, double azimuth_deg, double elevation_deg) {
  const double az = azimuth_deg * kDegree, el = elevation_deg * kDegree;
  const double enu[3] = {std::sin(az) * std::cos(el), std::cos(az) * std::cos(el), std::sin(el)};
  const CameraView<double> view = camera_view(camera);
  double c[3] = {0, 0, 0};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c[i] += view.camera_from_enu[i][j] * enu[j];
  return {0.5 * camera.width + view.lens.focal_px * c[0] / c[2],
          0.5 * camera.height + view.lens.focal_px * c[1] / c[2]};
}

Camera tilted() {
  Camera camera;
  camera.width = 641;
  camera.height = 480;
  camera.hfov_deg = 71.0;
  camera.azimuth_deg = 338.0;
  camera.elevation_deg = 24.0;
  camera.roll_deg = 7.0;
  return camera;
}

TEST(Camera, DirectionOfPixelUndoesTheProjection) {
  const Camera camera = tilted();
  for (double x : {0.5, 100.0, 320.5, 640.5}) {
    for (double y : {0.5, 200.0, 240.0, 479.5}) {
      const Direction d = direction_of_pixel(camera, x, y);
      const auto back = pixel_of(camera, d.azimuth_deg, d.elevation_deg);
      EXPECT_NEAR(back[0], x, 1e-9);
      EXPECT_NEAR(back[1], y, 1e-9);
      EXPECT_GE(d.azimuth_deg, 0.0);
      EXPECT_LT(d.azimuth_deg, 360.0);
    }
  }
}

TEST(Camera, ViewIsARotation) {
  const CameraView<double> view = camera_view(tilted());
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double dot = 0.0;
      for (int k = 0; k < 3; ++k) dot += view.camera_from_enu[i][k] * view.camera_from_enu[j][k];
      EXPECT_NEAR(dot, i == j ? 1.0 : 0.0, 1e-14);
    }
}

TEST(Camera, LooksToItsAzimuthFromNorthToTheEastAndElevation) {
  Camera camera = tilted();
  const Direction centre = direction_of_pixel(camera, 320.5, 240.0);
  EXPECT_NEAR(centre.azimuth_deg, 338.0, 1e-9);
  EXPECT_NEAR(centre.elevation_deg, 24.0, 1e-9);
  camera.roll_deg = 0.0;
  EXPECT_GT(direction_of_pixel(camera, 400.0, 240.0).azimuth_deg, 338.0) << "the right is further east";
  EXPECT_GT(direction_of_pixel(camera, 320.5, 200.0).elevation_deg, 24.0) << "up in the picture is up";
  camera.azimuth_deg = 90.0;
  camera.elevation_deg = 0.0;
  const CameraView<double> east = camera_view(camera);
  EXPECT_NEAR(east.camera_from_enu[2][0], 1.0, 1e-14);
  EXPECT_NEAR(east.camera_from_enu[0][1], -1.0, 1e-14) << "facing east, the right is the south";
}

TEST(Camera, RollTurnsTheSceneClockwiseInThePicture) {
  Camera camera = tilted();
  camera.roll_deg = 0.0;
  const auto level = pixel_of(camera, 338.0, 34.0);
  EXPECT_NEAR(level[0], 320.5, 1e-9);
  camera.roll_deg = 20.0;
  const auto rolled = pixel_of(camera, 338.0, 34.0);
  const double up = 240.0 - level[1];
  EXPECT_NEAR(rolled[0] - 320.5, up * std::sin(20.0 * kDegree), 1e-9) << "a point above moves to the right";
  EXPECT_NEAR(240.0 - rolled[1], up * std::cos(20.0 * kDegree), 1e-9);
}

TEST(Camera, FieldOfViewSpansTheWidth) {
  Camera camera = tilted();
  camera.roll_deg = camera.elevation_deg = 0.0;
  camera.azimuth_deg = 100.0;
  EXPECT_NEAR(direction_of_pixel(camera, 0.0, 240.0).azimuth_deg, 100.0 - 35.5, 1e-9);
  EXPECT_NEAR(direction_of_pixel(camera, 641.0, 240.0).azimuth_deg, 100.0 + 35.5, 1e-9);
}

TEST(Camera, ScaleGrowsAsItsDifferencesDo) {
  for (const LensModel model : {LensModel::pinhole, LensModel::equidistant}) {
    Camera more = tilted();
    more.model = model;
    more.focal_px = 300.0;
    Camera less = more;
    const double growth = pixels_per_degree_growth(more), step = 1e-3;
    (model == LensModel::pinhole ? more.hfov_deg : more.focal_px) += step;
    (model == LensModel::pinhole ? less.hfov_deg : less.focal_px) -= step;
    EXPECT_NEAR(growth, std::log(pixels_per_degree(more) / pixels_per_degree(less)) / (2.0 * step), 1e-9);
  }
}

}  // namespace
}  // namespace vegard::sim::camera_test
