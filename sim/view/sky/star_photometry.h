// The brightness and colour of stars in a sensor, above and below the air. docs/optics.md, "Stars".
#pragma once

#include <array>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/view/colour/sensor_response.h"
#include "sim/view/sky/air.h"

namespace vegard::sim {

/// Returns the photons cm^-2 s^-1 of 557.7 nm that are as bright to the eye as a star of a V magnitude:
/// 1.05e6 at magnitude 0, which is 2.54e-6 lx (Crumey 2014, MNRAS 442, 2600, doi:10.1093/mnras/stu992). AB
/// magnitudes in the eye's own band have 2.58e-6 lx (Bara 2017, arXiv:1710.06755); a star's colour changes it
/// by some hundredths. In the band V itself a star of magnitude 0 has 9.0e5 photons.
double star_photons_cm2_s(double magnitude);

/// Returns the temperature of the black body with a colour index B - V: Ballesteros 2012,
/// doi:10.1209/0295-5075/97/34008.
double colour_temperature_k(double colour_index);

/// Returns linear RGB, in a sensor, of light of luminance 1 from the black body of a colour index.
std::array<double, 3> star_tint(double colour_index, const SensorResponse& response);

/// Returns the linear value, at the scene's gain, of one photon cm^-2 s^-1 sr^-1 with a star_tint() of 1: the
/// scale of star_light(). 1 R = 1e6 / 4 pi photons cm^-2 s^-1 sr^-1.
double luminance_per_photon(const Scene& scene);

/// The transmission of the air for R, G and B in a direction.
class StarExtinction {
 public:
  explicit StarExtinction(const Scene& scene);
  std::array<double, 3> towards(double sine_of_elevation) const;

 private:
  AirAbove air_;
  std::vector<LineDepths<double>> depths_;
};

}  // namespace vegard::sim
