// The camera: converts directions between the observer's axes (east, north, up), the camera's axes (right,
// down, forward) and pixels.
#pragma once

#include <cmath>
#include <limits>

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/view/camera/cube_map.h"
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

// The pinhole cameras of a cube's faces.

/// Returns the pinhole camera with the view of one face of this camera, of face_px() x face_px() pixels.
Camera camera_of_face(const Camera& camera, const CubeFace& face);

// Changes the number of pixels of a camera without changing its view.

struct PictureSize {
  int width = 0, height = 0;
};

/// Returns the largest size within `most` that has the camera's aspect ratio, to the nearest pixel (of a
/// panorama exactly), and is not larger than the camera's own.
PictureSize size_within(const Camera& camera, const PictureSize& most);

/// Returns the camera with another number of pixels: the image at (x, y) moves to (x w' / w, y h' / h). If
/// the two ratios differ, pixels are not square. The lens's numbers stay in the previous pixels;
/// pixel_width_px and pixel_height_px have the conversion.
Camera scaled_camera(const Camera& camera, const PictureSize& size);

/// Returns the same camera with the lens's numbers in pixels of its own picture, as in scene files.
Camera in_own_pixels(const Camera& camera);

// Rays from the observer: through the centres of a film's cells, to the ground of a body, past the Earth's
// limb.

/// Computes the unit vector of the direction of a film's cell; returns false outside of the lens's picture.
template <class T>
bool enu_of_cell(const CameraView<T>& view, const FilmGeometry& film, int row, int column, T enu[3]) {
  return enu_of_pixel(view, film.x0_px + (column + 0.5) * film.cell_width_px,
                      film.y0_px + (row + 0.5) * film.cell_height_px, enu);
}

/// Returns the distance in km at which a ray from the observer meets the ground; infinity if it does not.
/// `up` is the third component of the direction.
inline double ground_km(double observer_altitude_km, double up, double sphere_km = kEarthRadiusKm) {
  const double radius = sphere_km + observer_altitude_km;
  const double along = radius * up;  // of the observer's place, from the Earth's centre
  const double square = along * along - (radius * radius - sphere_km * sphere_km);
  if (along >= 0.0 || square < 0.0) return std::numeric_limits<double>::infinity();
  return std::max(0.0, -along - std::sqrt(square));
}

/// From this altitude on, an observer is above the air that scatters light, and below the aurora: the edge of
/// the Earth below the horizontal is seen as a limb.
inline constexpr double kLimbObserverKm = 60.0;

/// Returns the lowest altitude of a line of sight in km, negative (below the surface) if the line hits the
/// Earth. NaN for elevations of 0 and above, where the observer is the lowest point.
double tangent_altitude_km(double observer_km, double elevation_deg);

/// The inverse of tangent_altitude_km(): at most 0. NaN unless -R <= tangent altitude <= observer.
double elevation_of_tangent_deg(double observer_km, double tangent_km);

/// Returns the distance from the observer to the lowest point; NaN for elevations of 0 and above.
double tangent_distance_km(double observer_km, double elevation_deg);

// The edges of a film as planes through the camera, to skip points that are surely off the film.

struct FilmEdges {
  int count = 0;         ///< number of planes; 0: the film is too wide for planes
  double outward[4][3];  ///< normals, of any length: a positive product with a point is off the film
};

/// Returns the edges of the film, enlarged by one cell on every side.
FilmEdges film_edges(const Lens<double>& lens, const FilmGeometry& film);

}  // namespace vegard::sim
