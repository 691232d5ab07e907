// The camera that a calibration fits: a lens (sim/view/camera/lens.h) and a rotation.
//
// For a camera that looks to the zenith, azimuth and roll are degenerate. The rotation is therefore a matrix,
// which small turns about the camera's own axes change; these are never degenerate.
#pragma once

#include <Eigen/Core>

#include <array>

#include "fit/photo/pointing/star_sighting.h"
#include "sim/view/camera/lens.h"

namespace vegard::fit {

/// The numbers that a calibration may fit.
enum LensNumber : int {
  turn_about_right,  ///< radians, about the camera's axes
  turn_about_down,
  turn_about_forward,
  focal_px_number,
  centre_x_number,  ///< the principal point, in pixels from the picture's upper left corner
  centre_y_number,
  aspect_ratio_number,
  radial_1_number,
  radial_2_number,
  radial_3_number,
  decentring_1_number,
  decentring_2_number,
  lens_numbers  ///< how many there are
};

/// Returns "focal_px", "k1"; the turns are "turn_right", "turn_down" and "turn_forward".
const char* name_of(LensNumber number);

struct SkyCamera {
  sim::LensModel model = sim::LensModel::equidistant;
  bool mirrored = false;
  Eigen::Matrix3d camera_from_enu = Eigen::Matrix3d::Identity();  ///< rows: right, down, forward
  /// Indexed by LensNumber. The turns are 0 except during a fit.
  std::array<double, lens_numbers> numbers{0, 0, 0, 100, 0, 0, 1, 0, 0, 0, 0, 0};
};

/// Returns the camera with its turns included in the rotation.
SkyCamera with_rotation_applied(const SkyCamera& camera);

/// Returns the cosine below which a model without terms has no image (sim::min_cosine() without its search).
inline double end_of_model(sim::LensModel model) {
  const bool half_a_sky = model == sim::LensModel::pinhole || model == sim::LensModel::orthographic;
  return half_a_sky ? 0.0 : -0.984807753012208;  // 170 degrees
}

/// Returns the lens with these numbers. Its image is limited by the model alone, also where radial terms fold
/// the picture back.
template <class T>
sim::Lens<T> lens_of(const SkyCamera& camera, const T numbers[lens_numbers]);

/// Returns the camera's lens as the simulator has it: it ends where radial terms fold the picture back.
sim::Lens<double> true_lens(const SkyCamera& camera);

/// Computes the place of a direction in the picture of a camera with these numbers; false if the lens has no
/// image of it.
template <class T>
bool place_of_star(const SkyCamera& camera, const T numbers[lens_numbers], const std::array<double, 3>& enu,
                   T& x_px, T& y_px);

/// The same with the camera's own numbers.
bool place_of_star(const SkyCamera& camera, const std::array<double, 3>& enu, double& x_px, double& y_px);

/// Azimuth, elevation and roll of a rotation, with their derivatives.
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

// ---------------------------------------------------------------------------------------------------------

template <class T>
sim::Lens<T> lens_of(const SkyCamera& camera, const T numbers[lens_numbers]) {
  sim::Lens<T> lens;
  lens.model = camera.model;
  lens.focal_px = numbers[focal_px_number];
  lens.aspect = numbers[aspect_ratio_number];
  lens.principal_x_px = numbers[centre_x_number];
  lens.principal_y_px = numbers[centre_y_number];
  lens.k1 = numbers[radial_1_number];
  lens.k2 = numbers[radial_2_number];
  lens.k3 = numbers[radial_3_number];
  lens.p1 = numbers[decentring_1_number];
  lens.p2 = numbers[decentring_2_number];
  lens.side = camera.mirrored ? -1.0 : 1.0;
  lens.min_cosine = end_of_model(camera.model);
  return lens;
}

template <class T>
bool place_of_star(const SkyCamera& camera, const T numbers[lens_numbers], const std::array<double, 3>& enu,
                   T& x_px, T& y_px) {
  const Eigen::Vector3d before = camera.camera_from_enu * Eigen::Vector3d(enu[0], enu[1], enu[2]);
  const T* w = numbers + turn_about_right;
  // Rodrigues's formula; its series where the angle is too small to divide by.
  const T square = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
  T first, second;
  if (sim::value_of(square) > 1e-8) {
    const T angle = sim::square_root(square);
    first = sim::sine(angle) / angle;
    const T half = sim::sine(angle * 0.5) / angle;
    second = half * half * 2.0;
  } else {
    first = T(1.0) - square * (1.0 / 6.0);
    second = T(0.5) - square * (1.0 / 24.0);
  }
  T across[3], in_camera[3];
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    across[i] = w[j] * before[k] - w[k] * before[j];
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    in_camera[i] = across[i] * first + (w[j] * across[k] - w[k] * across[j]) * second + before[i];
  }
  return sim::project(lens_of(camera, numbers), in_camera, x_px, y_px);
}

}  // namespace vegard::fit
