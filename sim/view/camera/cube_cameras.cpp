#include "sim/view/camera/cube_cameras.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/vec3.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

Camera camera_of_face(const Camera& camera, const CubeFace& face) {
  const CameraView<double> view = camera_view(camera);
  const auto in_enu = [&](const std::array<double, 3>& axis) {
    Vec3<double> enu{};
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < 3; ++a) enu[i] += axis[a] * view.camera_from_enu[a][i];
    return enu;
  };
  const Vec3<double> forward = in_enu(face.forward), right = in_enu(face.right);
  Camera one = camera;
  one.model = LensModel::pinhole;
  one.width = one.height = face_px(camera);
  one.hfov_deg = 90.0;
  one.pixel_width_px = one.pixel_height_px = 1.0;
  const double elevation = std::asin(std::clamp(forward[2], -1.0, 1.0));
  // Straight up and down any azimuth will do: the roll follows from it.
  const double azimuth = std::hypot(forward[0], forward[1]) > 1e-9 ? std::atan2(forward[0], forward[1]) : 0.0;
  const double sa = std::sin(azimuth), ca = std::cos(azimuth), se = std::sin(elevation),
               ce = std::cos(elevation);
  const Vec3<double> level_right = {ca, -sa, 0.0}, level_up = {-(sa * se), -(ca * se), ce};
  one.azimuth_deg = azimuth / kRadiansPerDegree;
  one.elevation_deg = elevation / kRadiansPerDegree;
  one.roll_deg = std::atan2(dot3(right, level_up), dot3(right, level_right)) / kRadiansPerDegree;
  return one;
}

}  // namespace vegard::sim
