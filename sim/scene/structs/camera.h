// [camera]: the geometry of a camera.
#pragma once

namespace vegard::sim {

/// The projection of a lens (sim/view/camera/lens.h). The pinhole has Brown's distortion; the polynomial is
/// one in the angle off the axis. The last two are panoramas of all directions: a map by longitude and
/// latitude, and the six faces of a cube.
enum class LensModel {
  pinhole,
  equidistant,
  equisolid,
  stereographic,
  orthographic,
  polynomial,
  equirectangular,
  cube
};

/// How a picture arranges the six faces of a cube (sim/view/camera/cube_map.h).
enum class CubeLayout {
  cross,  ///< four by three
  strip,  ///< six by one
  grid    ///< three by two
};

/// The geometry of a camera: its lens (sim/view/camera/lens.h), direction and picture size. The scale follows
/// from hfov_deg for a pinhole, from the picture's size for panoramas, and from focal_px for all others.
struct Camera {
  LensModel model = LensModel::pinhole;
  int width = 720;
  int height = 480;
  double hfov_deg = 60.0;    ///< of a pinhole without distortion, across the picture's width
  double focal_px = 300.0;   ///< of the other lenses: pixels per radian at the axis, horizontally
  double azimuth_deg = 0.0;  ///< of the lens's axis, the direction of the principal point
  double elevation_deg = 30.0;
  double roll_deg = 0.0;
  double principal_x_px = 0.0;  ///< of the principal point, to the right of the picture's middle
  double principal_y_px = 0.0;  ///< of the principal point, below the picture's middle
  double aspect = 1.0;          ///< vertical over horizontal scale
  bool mirrored = false;        ///< left and right are exchanged
  /// Radial terms. Pinhole: of r^2, r^4, r^6 (Brown, as in OpenCV); polynomial: of theta^2, theta^4, theta^6
  /// relative to the equidistant lens.
  double k1 = 0.0, k2 = 0.0, k3 = 0.0;
  double p1 = 0.0, p2 = 0.0;  ///< decentring terms, as in OpenCV
  /// Width and height of a pixel of the picture (width x height), in the pixels that focal_px and the
  /// principal point are given in. No key of a scene file; sim/view/camera/camera.h sets them.
  double pixel_width_px = 1.0, pixel_height_px = 1.0;
  CubeLayout cube_layout = CubeLayout::cross;  ///< of the model "cube"
};

}  // namespace vegard::sim
