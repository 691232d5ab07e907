#include "sim/view/camera/camera.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace vegard::sim {

const double& camera_number(const Camera& camera, CameraNumber which) {
  switch (which) {
    case azimuth_number:
      return camera.azimuth_deg;
    case elevation_number:
      return camera.elevation_deg;
    case roll_number:
      return camera.roll_deg;
    case scale_number:
      return camera.model == LensModel::pinhole ? camera.hfov_deg : camera.focal_px;
    case principal_x_number:
      return camera.principal_x_px;
    case principal_y_number:
      return camera.principal_y_px;
    case aspect_number:
      return camera.aspect;
    case k1_number:
      return camera.k1;
    case k2_number:
      return camera.k2;
    case k3_number:
      return camera.k3;
    case p1_number:
      return camera.p1;
    case p2_number:
      return camera.p2;
    case camera_numbers:
      break;
  }
  assert(false);
  return camera.azimuth_deg;
}

ParameterRole role_of(const Camera& camera, CameraNumber which) {
  switch (which) {
    case azimuth_number:
      return ParameterRole::camera_azimuth;
    case elevation_number:
      return ParameterRole::camera_elevation;
    case roll_number:
      return ParameterRole::camera_roll;
    case scale_number:
      return camera.model == LensModel::pinhole ? ParameterRole::field_of_view : ParameterRole::focal_length;
    case principal_x_number:
      return ParameterRole::principal_x;
    case principal_y_number:
      return ParameterRole::principal_y;
    case aspect_number:
      return ParameterRole::lens_aspect;
    case k1_number:
      return ParameterRole::lens_k1;
    case k2_number:
      return ParameterRole::lens_k2;
    case k3_number:
      return ParameterRole::lens_k3;
    case p1_number:
      return ParameterRole::lens_p1;
    case p2_number:
      return ParameterRole::lens_p2;
    case camera_numbers:
      break;
  }
  assert(false);
  return ParameterRole::none;
}

int camera_number_of(const Camera& camera, const ParameterId& id) {
  for (int which = 0; which < camera_numbers; ++which)
    if (role_of(camera, static_cast<CameraNumber>(which)) == id.role()) return which;
  return -1;
}

CameraView<double> camera_view(const Camera& camera) {
  return camera_view<double>(camera, [&](CameraNumber which) { return camera_number(camera, which); });
}

Direction direction_of_pixel(const Camera& camera, double x_px, double y_px) {
  double enu[3];
  if (!enu_of_pixel(camera_view(camera), x_px, y_px, enu)) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {kNone, kNone};
  }
  return direction_of_enu(enu);
}

Direction direction_of_enu(const double enu[3]) {
  Direction direction;
  direction.azimuth_deg = std::atan2(enu[0], enu[1]) / kRadiansPerDegree;
  if (direction.azimuth_deg < 0.0) direction.azimuth_deg += 360.0;
  direction.elevation_deg = std::atan2(enu[2], std::hypot(enu[0], enu[1])) / kRadiansPerDegree;
  return direction;
}

void enu_of_direction(const Direction& direction, double enu[3]) {
  const double azimuth = direction.azimuth_deg * kRadiansPerDegree;
  const double elevation = direction.elevation_deg * kRadiansPerDegree;
  enu[0] = std::cos(elevation) * std::sin(azimuth);
  enu[1] = std::cos(elevation) * std::cos(azimuth);
  enu[2] = std::sin(elevation);
}

double pixels_per_degree(const Camera& camera) {
  if (camera.model == LensModel::equirectangular) return camera.width / 360.0;
  if (camera.model == LensModel::cube) return face_px(camera) / 90.0;
  return camera.model == LensModel::pinhole ? camera.width / camera.hfov_deg
                                            : camera.focal_px / camera.pixel_width_px * kRadiansPerDegree;
}

double pixels_per_degree_growth(const Camera& camera) {
  return camera.model == LensModel::pinhole ? -1.0 / camera.hfov_deg : 1.0 / camera.focal_px;
}

double widest_angle_rad(const Lens<double>& lens, const FilmGeometry& film) {
  double least = 1.0;
  for (const double x_px :
       {film.x0_px - film.cell_width_px, film.x0_px + (film.columns + 1) * film.cell_width_px})
    for (const double y_px :
         {film.y0_px - film.cell_height_px, film.y0_px + (film.rows + 1) * film.cell_height_px}) {
      double direction[3] = {0.0, 0.0, lens.min_cosine};
      unproject(lens, x_px, y_px, direction);
      least = std::min(least, direction[2]);
    }
  return std::acos(std::clamp(least, lens.min_cosine, 1.0));
}

}  // namespace vegard::sim
