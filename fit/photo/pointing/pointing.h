// Azimuth, elevation and roll of a rotation, with their derivatives.
#pragma once

#include <Eigen/Core>

#include "fit/photo/pointing/sky_camera.h"

namespace vegard::fit {

struct Pointing {
  double azimuth_deg = 0.0;  ///< 0 to 360
  double elevation_deg = 0.0;
  double roll_deg = 0.0;  ///< -180 to 180
  /// The derivatives d (azimuth, elevation, roll) in degrees / d turns in radians.
  Eigen::Matrix3d by_turns = Eigen::Matrix3d::Zero();
};

/// Returns the angles, defined as in sim/view/camera/camera.h. Exactly at the zenith the azimuth is 0 and its
/// derivatives are not finite.
Pointing pointing_of(const SkyCamera& camera);

/// Returns the rotation with the rows right, down, forward.
Eigen::Matrix3d rotation_of(double azimuth_deg, double elevation_deg, double roll_deg);

}  // namespace vegard::fit
