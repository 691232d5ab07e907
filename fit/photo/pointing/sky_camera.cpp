#include "fit/photo/pointing/sky_camera.h"

#include <Eigen/Geometry>

#include <cmath>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

using Turns = sim::Dual<double, sim::Tangents<double, 3>>;

}  // namespace

const char* name_of(LensNumber number) {
  constexpr const char* kNames[lens_numbers] = {"turn_right",  "turn_down",   "turn_forward", "focal_px",
                                                "centre_x_px", "centre_y_px", "aspect",       "k1",
                                                "k2",          "k3",          "p1",           "p2"};
  return kNames[number];
}

SkyCamera with_rotation_applied(const SkyCamera& camera) {
  SkyCamera turned = camera;
  const Eigen::Vector3d turn(camera.numbers[0], camera.numbers[1], camera.numbers[2]);
  const double angle = turn.norm();
  if (angle > 0.0)
    turned.camera_from_enu =
        Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * camera.camera_from_enu;
  // Products of rotations lose their right angles digit by digit.
  turned.camera_from_enu = Eigen::Quaterniond(turned.camera_from_enu).normalized().toRotationMatrix();
  for (int i = turn_about_right; i <= turn_about_forward; ++i) turned.numbers[i] = 0.0;
  return turned;
}

sim::Lens<double> true_lens(const SkyCamera& camera) {
  sim::Lens<double> lens = lens_of(camera, camera.numbers.data());
  lens.min_cosine = sim::min_cosine(lens.model, lens.k1, lens.k2, lens.k3);
  return lens;
}

bool place_of_star(const SkyCamera& camera, const std::array<double, 3>& enu, double& x_px, double& y_px) {
  return place_of_star(camera, camera.numbers.data(), enu, x_px, y_px);
}

Pointing pointing_of(const SkyCamera& camera) {
  // A small turn w takes every vector v to v + w x v: rows of the matrix by column.
  Turns m[3][3];
  for (int column = 0; column < 3; ++column)
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      m[i][column] = Turns(camera.camera_from_enu(i, column));
      m[i][column].d.t[j] = camera.camera_from_enu(k, column);
      m[i][column].d.t[k] = -camera.camera_from_enu(j, column);
    }
  const Turns &east = m[2][0], &north = m[2][1], &up = m[2][2];
  const Turns level = sim::square_root(east * east + north * north);
  const Turns azimuth = sim::arctangent(east, north), elevation = sim::arctangent(up, level);
  // The components of the camera's right along the horizontal and along the upright across the line of sight.
  const Turns sa = sim::sine(azimuth), ca = sim::cosine(azimuth);
  const Turns se = sim::sine(elevation), ce = sim::cosine(elevation);
  const Turns along_level = m[0][0] * ca - m[0][1] * sa;
  const Turns along_upright = m[0][2] * ce - (m[0][0] * sa + m[0][1] * ca) * se;
  const Turns roll = sim::arctangent(along_upright, along_level);
  const Turns* angles[3] = {&azimuth, &elevation, &roll};
  Pointing pointing;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) pointing.by_turns(i, j) = angles[i]->d.t[j] / sim::kRadiansPerDegree;
  pointing.azimuth_deg = azimuth.v / sim::kRadiansPerDegree;
  if (pointing.azimuth_deg < 0.0) pointing.azimuth_deg += 360.0;
  pointing.elevation_deg = elevation.v / sim::kRadiansPerDegree;
  pointing.roll_deg = roll.v / sim::kRadiansPerDegree;
  return pointing;
}

Eigen::Matrix3d rotation_of(double azimuth_deg, double elevation_deg, double roll_deg) {
  const double a = azimuth_deg * sim::kRadiansPerDegree, e = elevation_deg * sim::kRadiansPerDegree;
  const double r = roll_deg * sim::kRadiansPerDegree;
  const Eigen::Vector3d forward(std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e));
  const Eigen::Vector3d level(std::cos(a), -std::sin(a), 0.0);
  const Eigen::Vector3d upright(-std::sin(a) * std::sin(e), -std::cos(a) * std::sin(e), std::cos(e));
  Eigen::Matrix3d rows;
  rows.row(0) = level * std::cos(r) + upright * std::sin(r);
  rows.row(1) = level * std::sin(r) - upright * std::cos(r);
  rows.row(2) = forward;
  return rows;
}

}  // namespace vegard::fit
