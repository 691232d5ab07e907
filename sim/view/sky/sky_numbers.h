// The numbers of a scene that the air and the night sky depend on and that a fit may free, as doubles or as
// dual numbers with a tangent for each of them; and the camera's lines of sight by them.
#pragma once

#include <vector>

#include "sim/base/number/dual.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

enum SkyNumber : int {
  sky_aerosol_depth,
  sky_angstrom,
  sky_green,
  sky_red,
  sky_sodium,
  sky_pollution,
  first_sky_camera,  ///< from here on one for every CameraNumber
  sky_numbers = first_sky_camera + camera_numbers
};

/// Tangents by the scene's own units (degrees, rayleighs, mcd m^-2).
using SkyDual = Dual<double, Tangents<double, sky_numbers>>;

ParameterId sky_number_id(const Scene& scene, SkyNumber which);

/// For every free parameter the SkyNumber that it is, or -1.
std::vector<int> sky_numbers_of(const Scene& scene, const std::vector<ParameterId>& free);

/// Its value; a SkyDual has a tangent of 1 by itself. T is double or SkyDual.
template <class T>
T sky_number(const Scene& scene, SkyNumber which);
template <>
double sky_number<double>(const Scene& scene, SkyNumber which);
template <>
SkyDual sky_number<SkyDual>(const Scene& scene, SkyNumber which);

/// A line of sight, of length 1.
template <class T>
struct SightLine {
  T east, north, up;
};

/// The camera's lines of sight. T is double or SkyDual.
template <class T>
class SkyView {
 public:
  explicit SkyView(const Scene& scene);

  /// Outside of the lens's picture, where nothing is to be seen, straight up.
  SightLine<T> at(double x_px, double y_px) const {
    T enu[3];
    if (!enu_of_pixel(view_, x_px, y_px, enu)) return {T(0.0), T(0.0), T(1.0)};
    return {enu[0], enu[1], enu[2]};
  }

  /// Whether the lens has an image of anything there.
  bool sees(double x_px, double y_px) const {
    double in_camera[3];
    return is_plain_pinhole(plain_) || unproject(plain_, x_px, y_px, in_camera);
  }

 private:
  CameraView<T> view_;
  Lens<double> plain_;
};

}  // namespace vegard::sim
