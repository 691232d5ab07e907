// Moonlight scattered by the air.
//
// K. Krisciunas and B. E. Schaefer 1991, "A model of the brightness of moonlight", Publications of the
// Astronomical Society of the Pacific 103, 1033, doi:10.1086/132921, equations (3), (9) and (15) to (21):
// scattering by molecules and by aerosol as functions of the angle from the Moon, accurate to 8 to 23 %. The
// colours are ours: the Moon's (a black body with B - V = 0.92) times wavelength^-4 for molecules and
// wavelength^-angstrom_exponent for aerosol.
#pragma once

#include <array>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/colour/matrix3.h"
#include "sim/view/sky/sky_numbers.h"

namespace vegard::sim {

/// Returns the airmass of Krisciunas and Schaefer's equation (3): 5 at the horizon.
template <class T>
T moonlit_airmass(const T& sine_of_elevation) {
  return 1.0 / square_root(1.0 - 0.96 * (1.0 - sine_of_elevation * sine_of_elevation));
}

/// Return the scattered light as a function of the cosine of the angle from the Moon, in the paper's units:
/// equations (16) to (19) and (21). For aerosol, the larger of (18) and (19), 6.2e7 over the square of the
/// angle, is used within 10 degrees of the Moon. The two are equal at 8.46 degrees, so that there is no step
/// (at 10 degrees (19) is 22 % less). Within the radius of the Moon, 0.26 degrees, the value is that of the
/// limb.
template <class T>
T moonlit_by_molecules(const T& cosine) {
  return std::pow(10.0, 5.36) * (1.06 + cosine * cosine);
}
template <class T>
T moonlit_by_aerosol(const T& cosine) {
  const T angle_deg =
      arctangent(square_root(1.0 - cosine * cosine + 1e-12), cosine) * (1.0 / kRadiansPerDegree);
  constexpr double kMoonsEdge_deg = 0.26, kNearMoon_deg = 10.0, kNearMoon = 6.2e7;
  const T far = exponential((6.15 - angle_deg * (1.0 / 40.0)) * std::log(10.0));
  if (value_of(angle_deg) >= kNearMoon_deg) return far;
  if (value_of(angle_deg) < kMoonsEdge_deg) return T(kNearMoon / (kMoonsEdge_deg * kMoonsEdge_deg));
  const T near = kNearMoon / (angle_deg * angle_deg);
  return value_of(near) > value_of(far) ? near : far;
}

/// The moonlit sky of a scene; none() if moon.skylight is false, the Moon is down or the observer is above
/// the air.
class MoonlitSky {
 public:
  explicit MoonlitSky(const Scene& scene);

  bool none() const { return none_; }

  /// Returns linear RGB for a line of sight above the horizon; T is double or a dual number over it.
  template <class T>
  std::array<T, 3> light(const SightLine<T>& line) const {
    const T towards = line.east * moon_[0] + line.north * moon_[1] + line.up * moon_[2];
    const double limit = 1.0 - 1e-9;
    const T cosine = value_of(towards) > limit ? T(limit) : towards;
    const T sine = value_of(line.up) > 0.0 ? line.up : T(0.0);
    const T scattered = 1.0 - exponential(moonlit_airmass(sine) * (-depth_));
    const T molecules = moonlit_by_molecules(cosine) * scattered,
            aerosol = moonlit_by_aerosol(cosine) * scattered;
    return {molecules * of_molecules_[0] + aerosol * of_aerosol_[0],
            molecules * of_molecules_[1] + aerosol * of_aerosol_[1],
            molecules * of_molecules_[2] + aerosol * of_aerosol_[2]};
  }

 private:
  bool none_ = true;
  std::array<double, 3> moon_{};
  double depth_ = 0.0;  ///< vertical optical depth in V
  Vector3 of_molecules_{}, of_aerosol_{};
};

/// Returns the luminance of Krisciunas and Schaefer's model in cd m^-2, for tests and comparisons. Angles are
/// in degrees, the extinction in magnitudes per airmass.
double moonlit_luminance_cd_m2(double phase_angle_deg, double from_moon_deg, double moon_elevation_deg,
                               double elevation_deg, double extinction_mag);

}  // namespace vegard::sim
