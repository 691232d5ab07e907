// The camera: from the observer's east, north, up to its right, down, forward, through the lens and on to the
// film.
#pragma once

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/view/camera/lens.h"

namespace vegard::sim {

/// Where the cells of a film lie on the camera's pixels. Columns run to the right, rows down; cell (0, 0) has
/// its upper left corner at pixel coordinates (x0_px, y0_px), which may lie outside the picture (a margin for
/// the blur).
struct FilmGeometry {
  double x0_px = 0.0, y0_px = 0.0;
  double cell_width_px = 1.0, cell_height_px = 1.0;
  int columns = 0, rows = 0;
  /// Of wide cells: over how many pixels about the border of two cells light goes over from one to the other.
  /// 0: from centre to centre.
  double ramp_px = 0.0;
  /// Of a film that goes around all of an equirectangular picture: how many of its columns are 360 degrees
  /// and of its rows 180 degrees, what is beyond them a margin. 0: it does not.
  int turn_columns = 0, turn_rows = 0;
};

/// The numbers of a camera that a picture changes with, and that a fit may free.
enum CameraNumber : int {
  azimuth_number,
  elevation_number,
  roll_number,
  scale_number,  ///< hfov_deg of a pinhole, focal_px of every other lens
  principal_x_number,
  principal_y_number,
  aspect_number,
  k1_number,
  k2_number,
  k3_number,
  p1_number,
  p2_number,
  camera_numbers  ///< how many there are
};

const double& camera_number(const Camera& camera, CameraNumber which);

/// What it is in the table, of this camera's lens.
ParameterRole role_of(const Camera& camera, CameraNumber which);

/// The CameraNumber that a parameter is; -1 for one that this camera's picture does not depend on.
int camera_number_of(const Camera& camera, const ParameterId& id);

/// A camera ready to look. T is double or a dual number.
template <class T>
struct CameraView {
  T camera_from_enu[3][3];  ///< rows: right, down, forward
  Lens<T> lens;
};

/// `number(which)` gives each CameraNumber in the scene's units, as T. Azimuth from north to the east,
/// elevation from the horizon, roll clockwise as seen by the observer.
template <class T, class Number>
CameraView<T> camera_view(const Camera& camera, const Number& number) {
  const T azimuth = number(azimuth_number) * kRadiansPerDegree;
  const T elevation = number(elevation_number) * kRadiansPerDegree;
  const T roll = number(roll_number) * kRadiansPerDegree;
  const T sa = sine(azimuth), ca = cosine(azimuth), se = sine(elevation), ce = cosine(elevation);
  const T sr = sine(roll), cr = cosine(roll);
  const T level_right[3] = {ca, -sa, sa * 0.0};
  const T level_up[3] = {-(sa * se), -(ca * se), ce};
  CameraView<T> view;
  for (int i = 0; i < 3; ++i) {
    view.camera_from_enu[0][i] = level_right[i] * cr + level_up[i] * sr;
    view.camera_from_enu[1][i] = -(level_up[i] * cr - level_right[i] * sr);
  }
  view.camera_from_enu[2][0] = sa * ce;
  view.camera_from_enu[2][1] = ca * ce;
  view.camera_from_enu[2][2] = se;

  Lens<T>& lens = view.lens;
  lens.model = camera.model;
  const T scale = number(scale_number);
  lens.focal_px = lens.model == LensModel::pinhole
                      ? (0.5 * camera.width) / tangent(scale * (0.5 * kRadiansPerDegree))
                      : scale * (1.0 / camera.pixel_width_px);
  lens.principal_x_px = number(principal_x_number) * (1.0 / camera.pixel_width_px) + 0.5 * camera.width;
  lens.principal_y_px = number(principal_y_number) * (1.0 / camera.pixel_height_px) + 0.5 * camera.height;
  lens.aspect = number(aspect_number) * (camera.pixel_width_px / camera.pixel_height_px);
  lens.k1 = number(k1_number);
  lens.k2 = number(k2_number);
  lens.k3 = number(k3_number);
  lens.p1 = number(p1_number);
  lens.p2 = number(p2_number);
  lens.side = camera.mirrored ? -1.0 : 1.0;
  lens.min_cosine = min_cosine(lens.model, camera.k1, camera.k2, camera.k3);
  if (is_panorama(lens.model)) {
    lens.focal_px = T(lens.model == LensModel::cube ? 0.5 * face_px(camera) : camera.width / (2.0 * kPi));
    lens.aspect = T(lens.model == LensModel::cube ? 1.0 : 2.0 * camera.height / camera.width);
    lens.principal_x_px = T(0.5 * camera.width);
    lens.principal_y_px = T(0.5 * camera.height);
    lens.cube_layout = camera.cube_layout;
  }
  return view;
}

/// The scene's camera.
CameraView<double> camera_view(const Camera& camera);

/// The direction, of length 1, in which a place of the picture looks; false outside of the lens's picture.
template <class T>
bool enu_of_pixel(const CameraView<T>& view, double x_px, double y_px, T enu[3]) {
  T in_camera[3];
  if (!unproject(view.lens, x_px, y_px, in_camera)) return false;
  for (int i = 0; i < 3; ++i)
    enu[i] = in_camera[0] * view.camera_from_enu[0][i] + in_camera[1] * view.camera_from_enu[1][i] +
             in_camera[2] * view.camera_from_enu[2][i];
  return true;
}

/// Where a direction, of any length, is seen; false if the lens has no image of it.
template <class T>
bool pixel_of_enu(const CameraView<T>& view, const T enu[3], T& x_px, T& y_px) {
  T in_camera[3];
  for (int r = 0; r < 3; ++r)
    in_camera[r] = view.camera_from_enu[r][0] * enu[0] + view.camera_from_enu[r][1] * enu[1] +
                   view.camera_from_enu[r][2] * enu[2];
  return project(view.lens, in_camera, x_px, y_px);
}

/// A direction as an observer states it.
struct Direction {
  double azimuth_deg = 0.0;  ///< 0 to 360
  double elevation_deg = 0.0;
};

/// Where the pixel coordinate (x, y) looks; NaN outside of the lens's picture.
Direction direction_of_pixel(const Camera& camera, double x_px, double y_px);

/// Of a unit vector, and back.
Direction direction_of_enu(const double enu[3]);
void enu_of_direction(const Direction& direction, double enu[3]);

/// Pixels to a degree: of a pinhole the mean across the picture, width / hfov_deg; of others that on the
/// axis, of panoramas the mean along a level line.
double pixels_per_degree(const Camera& camera);

/// The camera's number that pixels_per_degree() depends on has this share in it: d ln pixels_per_degree / d
/// number.
double pixels_per_degree_growth(const Camera& camera);

// How far off the lens's axis a film reaches.

/// The angle off the axis of the film's farthest corner, a cell beyond its edge, in radians; that of the
/// lens's end if the film reaches beyond it.
double widest_angle_rad(const Lens<double>& lens, const FilmGeometry& film);

}  // namespace vegard::sim
