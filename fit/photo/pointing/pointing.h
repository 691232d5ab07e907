// Azimuth, elevation and roll of a rotation, with what is known of them.
#pragma once

#include <Eigen/Core>

#include "fit/photo/pointing/sky_camera.h"

namespace vegard::fit {

struct Pointing {
  double azimuth_deg = 0.0;  ///< 0 to 360
  double elevation_deg = 0.0;
  double roll_deg = 0.0;  ///< -180 to 180
  /// d (azimuth, elevation, roll) in degrees / d turns in radians.
  Eigen::Matrix3d by_turns = Eigen::Matrix3d::Zero();
};

/// Angles as sim/view/camera/camera.h has them. Exactly at the zenith the azimuth is 0 and its derivatives
/// are not finite.
Pointing pointing_of(const SkyCamera& camera);

/// Rows: right, down, forward.
Eigen::Matrix3d rotation_of(double azimuth_deg, double elevation_deg, double roll_deg);

}  // namespace vegard::fit
