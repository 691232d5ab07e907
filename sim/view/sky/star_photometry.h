// How bright and of which colour stars are to a sensor, above the air and below it. docs/optics.md, "Stars".
#pragma once

#include <array>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/view/colour/sensor_response.h"
#include "sim/view/sky/air.h"

namespace vegard::sim {

/// Photons cm^-2 s^-1 of 557.7 nm that are as bright to the eye as a star of a V magnitude: 1.05e6 at
/// magnitude 0, which is 2.54e-6 lx (Crumey 2014, MNRAS 442, 2600, doi:10.1093/mnras/stu992). AB magnitudes
/// in the eye's own band have 2.58e-6 lx (Bara 2017, arXiv:1710.06755); a star's colour changes it by some
/// hundredths. In the band V itself a star of magnitude 0 has 9.0e5 photons.
double star_photons_cm2_s(double magnitude);

/// Of the black body that a colour index B - V stands for: Ballesteros 2012,
/// doi:10.1209/0295-5075/97/34008.
double colour_temperature_k(double colour_index);

/// Linear RGB, through a sensor, of light of luminance 1 from a black body of that temperature.
std::array<double, 3> star_tint(double colour_index, const SensorResponse& response);

/// Linear RGB, at the scene's own gain, of one photon cm^-2 s^-1 sr^-1 of light of luminance-true tint 1:
/// what brightness is in star_light(). 1 R = 1e6 / 4 pi photons per cm2, s and sr.
double luminance_per_photon(const Scene& scene);

/// What the air lets through of R, G and B towards a direction.
class StarExtinction {
 public:
  explicit StarExtinction(const Scene& scene);
  std::array<double, 3> towards(double sine_of_elevation) const;

 private:
  AirAbove air_;
  std::vector<LineDepths<double>> depths_;
};

}  // namespace vegard::sim
