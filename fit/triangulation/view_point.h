// A camera that stands somewhere on the Earth: from its pixels to lines of sight in the Earth's axes, and
// back.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "fit/photo/pointing/horizon_calibration.h"
#include "fit/triangulation/earth_shape.h"
#include "sim/scene/structs/camera.h"
#include "sim/scene/structs/site.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {

/// A camera with what is not known of it.
struct PlacedCamera {
  std::string name;  ///< for messages and tables
  sim::Camera camera;
  sim::Site site;
  /// Standard error of the camera's orientation about each of three perpendicular axes, in common to all of
  /// its pixels.
  double pointing_error_deg = 0.0;
  double clock_error_s = 0.0;  ///< standard error
  /// Whether its directions are those in which stars are seen, raised by refraction.
  bool is_refracted = true;
};

class ViewPoint {
 public:
  ViewPoint(const PlacedCamera& camera, EarthShape shape);

  const PlacedCamera& camera() const { return camera_; }
  EarthShape shape() const { return shape_; }
  const Eigen::Vector3d& place_km() const { return place_km_; }  ///< from the Earth's centre

  /// Returns the unit vector of a pixel's line of sight, with refraction taken off; none outside of the
  /// lens's picture. Pixels are those of sim/view/camera/lens.h.
  std::optional<Eigen::Vector3d> direction(const PixelPoint& pixel) const;
  /// Returns the derivatives of direction() by x_px and y_px, in radians to a pixel; none as above.
  std::optional<Eigen::Matrix<double, 3, 2>> slopes(const PixelPoint& pixel) const;
  /// Returns where the camera sees a place, which may be outside of its picture; none if its lens has no
  /// image of it.
  std::optional<PixelPoint> pixel(const Eigen::Vector3d& place_km) const;
  bool has(const PixelPoint& pixel) const;  ///< it lies in the picture

  /// Whether the Earth is between the camera and the place.
  bool is_hidden(const Eigen::Vector3d& place_km) const;

 private:
  PlacedCamera camera_;
  EarthShape shape_;
  sim::CameraView<double> view_;
  Eigen::Matrix3d axes_;  ///< rows: east, north, up
  Eigen::Vector3d place_km_;
};

/// Returns the camera turned by a small angle about one of three perpendicular axes, 0 to 2.
ViewPoint turned(const ViewPoint& view, int axis, double by_deg);

}  // namespace vegard::fit
