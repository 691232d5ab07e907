#include "fit/photo/pointing/sky_camera.h"

#include <Eigen/Geometry>

namespace vegard::fit {

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

}  // namespace vegard::fit
