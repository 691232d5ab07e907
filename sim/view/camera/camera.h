// The camera: converts directions between the observer's axes (east, north, up), the camera's axes (right,
// down, forward) and pixels.
#pragma once

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/view/camera/lens.h"

namespace vegard::sim {

/// The position of a film's cells on the camera's pixels. Columns run to the right, rows down; cell (0, 0)
/// has its upper left corner at pixel coordinates (x0_px, y0_px), which may lie outside the picture (a margin
/// for the blur).
struct FilmGeometry {
  double x0_px = 0.0, y0_px = 0.0;
  double cell_width_px = 1.0, cell_height_px = 1.0;
  int columns = 0, rows = 0;
  /// Of wide cells: the width in pixels, around the border of two cells, of the transition of light from one
  /// cell to the other. 0: from centre to centre.
  double ramp_px = 0.0;
  /// Of a film around a whole equirectangular picture: the numbers of columns for 360 degrees and of rows for
  /// 180 degrees; the rest is a margin. 0: any other film.
  int turn_columns = 0, turn_rows = 0;
};

/// The numbers of a camera that change the picture and that a fit may free.
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
  camera_numbers  ///< number of CameraNumbers
};

const double& camera_number(const Camera& camera, CameraNumber which);

/// Returns the role of a number in the parameter table, for this camera's lens.
ParameterRole role_of(const Camera& camera, CameraNumber which);

/// Returns the CameraNumber of a parameter; -1 if this camera's picture does not depend on the parameter.
int camera_number_of(const Camera& camera, const ParameterId& id);

/// A camera prepared for projections. T is double or a dual number.
template <class T>
struct CameraView {
  T camera_from_enu[3][3];  ///< rows: right, down, forward
  Lens<T> lens;
};

/// Returns the view of a camera; `number(which)` returns each CameraNumber in the scene's units, as T.
/// Azimuth is from north to the east, elevation from the horizon, roll clockwise as seen by the observer.
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

/// Returns the view of a camera with the camera's own numbers.
CameraView<double> camera_view(const Camera& camera);

/// Computes the unit vector of the direction of a pixel; returns false outside of the lens's picture.
template <class T>
bool enu_of_pixel(const CameraView<T>& view, double x_px, double y_px, T enu[3]) {
  T in_camera[3];
  if (!unproject(view.lens, x_px, y_px, in_camera)) return false;
  for (int i = 0; i < 3; ++i)
    enu[i] = in_camera[0] * view.camera_from_enu[0][i] + in_camera[1] * view.camera_from_enu[1][i] +
             in_camera[2] * view.camera_from_enu[2][i];
  return true;
}

/// Computes the pixel of a direction of any length; returns false if the lens has no image of it.
template <class T>
bool pixel_of_enu(const CameraView<T>& view, const T enu[3], T& x_px, T& y_px) {
  T in_camera[3];
  for (int r = 0; r < 3; ++r)
    in_camera[r] = view.camera_from_enu[r][0] * enu[0] + view.camera_from_enu[r][1] * enu[1] +
                   view.camera_from_enu[r][2] * enu[2];
  return project(view.lens, in_camera, x_px, y_px);
}

/// A direction by azimuth and elevation.
struct Direction {
  double azimuth_deg = 0.0;  ///< 0 to 360
  double elevation_deg = 0.0;
};

/// Returns the direction of the pixel coordinates (x, y); NaN outside of the lens's picture.
Direction direction_of_pixel(const Camera& camera, double x_px, double y_px);

/// Convert a unit vector (east, north, up) to a direction, and back.
Direction direction_of_enu(const double enu[3]);
void enu_of_direction(const Direction& direction, double enu[3]);

/// Returns the scale in pixels per degree: of a pinhole the mean across the picture, width / hfov_deg; of
/// panoramas the mean along a horizontal line; of other lenses the scale on the axis.
double pixels_per_degree(const Camera& camera);

/// Returns d ln pixels_per_degree() / d number for the camera's number on which it depends.
double pixels_per_degree_growth(const Camera& camera);

// The extent of a film.

/// Returns the angle off the axis, in radians, of the film's farthest corner, a cell beyond its edge; at most
/// that of the edge of the lens's picture.
double widest_angle_rad(const Lens<double>& lens, const FilmGeometry& film);

}  // namespace vegard::sim
