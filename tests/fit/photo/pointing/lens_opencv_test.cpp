// The pinhole with distortion beside OpenCV's, whose coefficients it has.
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <vector>

#include "sim/view/camera/camera.h"

namespace vegard::lens_opencv_test {
namespace {

TEST(LensBesideOpenCv, ProjectsTheSame) {
  sim::Camera camera;
  camera.hfov_deg = 70.0;
  camera.principal_x_px = 6.5;
  camera.principal_y_px = -3.25;
  camera.aspect = 1.02;
  camera.k1 = -0.21;
  camera.k2 = 0.07;
  camera.p1 = 0.0011;
  camera.p2 = -0.0023;
  camera.k3 = -0.004;
  const sim::Lens<double> lens = sim::camera_view(camera).lens;
  const cv::Matx33d matrix(lens.focal_px, 0.0, lens.principal_x_px, 0.0, lens.focal_px * lens.aspect,
                           lens.principal_y_px, 0.0, 0.0, 1.0);
  const std::vector<double> coefficients = {camera.k1, camera.k2, camera.p1, camera.p2, camera.k3};
  std::vector<cv::Point3d> points;
  for (double y = -0.5; y <= 0.5; y += 0.25)
    for (double x = -0.6; x <= 0.6; x += 0.3) points.emplace_back(x * 3.0, y * 3.0, 3.0);
  std::vector<cv::Point2d> places;
  cv::projectPoints(points, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), matrix, coefficients, places);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double direction[3] = {points[i].x, points[i].y, points[i].z};
    double x = 0.0, y = 0.0;
    ASSERT_TRUE(sim::project(lens, direction, x, y));
    // OpenCV's centre of the first pixel is (0, 0) or (0.5, 0.5) as the principal point has it.
    EXPECT_NEAR(x, places[i].x, 1e-9);
    EXPECT_NEAR(y, places[i].y, 1e-9);
  }
}

}  // namespace
}  // namespace vegard::lens_opencv_test
