// The parameters of a scene that the air and the night sky depend on and that a fit may free, as doubles or
// as dual numbers with a tangent for each parameter; and the camera's lines of sight as functions of them.
#pragma once

#include <vector>

#include "sim/base/number/dual.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

struct Scene;

enum SkyNumber : int {
  sky_aerosol_depth,
  sky_angstrom,
  sky_green,
  sky_red,
  sky_sodium,
  sky_pollution,
  first_sky_camera,  ///< from here on: one for every CameraNumber
  sky_numbers = first_sky_camera + camera_numbers
};

/// Tangents are in the scene's units (per degree, rayleigh, mcd m^-2).
using SkyDual = Dual<double, Tangents<double, sky_numbers>>;

ParameterId sky_number_id(const Scene& scene, SkyNumber which);

/// Returns the SkyNumber of every free parameter, or -1.
std::vector<int> sky_numbers_of(const Scene& scene, const std::vector<ParameterId>& free);

/// Returns the parameter's value; a SkyDual has the tangent 1 by that parameter. T is double or SkyDual.
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

  /// Returns the line of sight of a point of the picture; outside of the lens's picture, the zenith.
  SightLine<T> at(double x_px, double y_px) const {
    T enu[3];
    if (!enu_of_pixel(view_, x_px, y_px, enu)) return {T(0.0), T(0.0), T(1.0)};
    return {enu[0], enu[1], enu[2]};
  }

  /// True if the point is inside the lens's picture.
  bool sees(double x_px, double y_px) const {
    double in_camera[3];
    return is_plain_pinhole(plain_) || unproject(plain_, x_px, y_px, in_camera);
  }

 private:
  CameraView<T> view_;
  Lens<double> plain_;
};

}  // namespace vegard::sim
