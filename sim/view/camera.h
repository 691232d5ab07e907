// The camera: from the observer's east, north, up to its right, down, forward, and on to the film.
#pragma once

#include "sim/base/dual.h"
#include "sim/base/earth.h"
#include "sim/scene/scene.h"

namespace vegard::sim {

/// Where the cells of a film lie on the camera's pixels. Columns run to the right, rows down; cell (0, 0) has
/// its upper left corner at pixel coordinates (x0_px, y0_px), which may lie outside the picture (a margin for
/// the blur).
struct FilmGeometry {
  double x0_px = 0.0, y0_px = 0.0;
  double cell_width_px = 1.0, cell_height_px = 1.0;
  int columns = 0, rows = 0;
};

/// A pinhole. T is double or LocalDual.
template <class T>
struct PinholeView {
  T camera_from_enu[3][3];  ///< rows: right, down, forward
  T focal_px;
};

/// Azimuth from north to the east, elevation from the horizon, roll clockwise as seen by the observer, all in
/// radians; hfov across the width.
template <class T>
PinholeView<T> pinhole_view(const T& azimuth, const T& elevation, const T& roll, const T& hfov,
                            double width_px) {
  const T sa = sine(azimuth), ca = cosine(azimuth), se = sine(elevation), ce = cosine(elevation);
  const T sr = sine(roll), cr = cosine(roll);
  const T level_right[3] = {ca, -sa, sa * 0.0};
  const T level_up[3] = {-(sa * se), -(ca * se), ce};
  PinholeView<T> view;
  for (int i = 0; i < 3; ++i) {
    view.camera_from_enu[0][i] = level_right[i] * cr + level_up[i] * sr;
    view.camera_from_enu[1][i] = -(level_up[i] * cr - level_right[i] * sr);
  }
  view.camera_from_enu[2][0] = sa * ce;
  view.camera_from_enu[2][1] = ca * ce;
  view.camera_from_enu[2][2] = se;
  view.focal_px = (0.5 * width_px) / tangent(hfov * 0.5);
  return view;
}

/// The scene's camera.
PinholeView<double> pinhole_view(const Camera& camera);

/// A direction as an observer states it.
struct Direction {
  double azimuth_deg = 0.0;  ///< 0 to 360
  double elevation_deg = 0.0;
};

/// Where the pixel coordinate (x, y) looks.
Direction direction_of_pixel(const Camera& camera, double x_px, double y_px);

}  // namespace vegard::sim
