// The numbers of a scene that the air and the night sky depend on and that a fit may free, as doubles or as
// dual numbers with a tangent for each of them; and the camera's lines of sight by them.
#pragma once

#include <vector>

#include "sim/base/dual.h"
#include "sim/scene/scene.h"
#include "sim/view/camera.h"

namespace vegard::sim {

enum SkyNumber : int {
  sky_camera_azimuth,
  sky_camera_elevation,
  sky_camera_roll,
  sky_camera_hfov,
  sky_aerosol_depth,
  sky_angstrom,
  sky_green,
  sky_red,
  sky_sodium,
  sky_pollution,
  sky_numbers
};

/// Tangents by the scene's own units (degrees, rayleighs, mcd m^-2).
using SkyDual = Dual<double, Tangents<double, sky_numbers>>;

/// Where the number lives in the scene.
const double* sky_number_address(const Scene& scene, SkyNumber which);

/// For every free parameter the SkyNumber that it is, or -1.
std::vector<int> sky_numbers_of(const Scene& scene, const std::vector<const double*>& free);

/// Its value; a SkyDual has a tangent of 1 by itself. T is double or SkyDual.
template <class T>
T sky_number(const Scene& scene, SkyNumber which);

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

  SightLine<T> at(double x_px, double y_px) const {
    const T right = T(x_px - 0.5 * width_px_), down = T(y_px - 0.5 * height_px_);
    const auto& m = view_.camera_from_enu;
    const T& f = view_.focal_px;
    const T scale = 1.0 / square_root(right * right + down * down + f * f);
    SightLine<T> line;
    T* const to[3] = {&line.east, &line.north, &line.up};
    for (int i = 0; i < 3; ++i) *to[i] = (right * m[0][i] + down * m[1][i] + f * m[2][i]) * scale;
    return line;
  }

 private:
  PinholeView<T> view_;
  double width_px_, height_px_;
};

}  // namespace vegard::sim
