// How bright and of which colour stars are to a sensor, above the air and below it. docs/optics.md, "Stars".
#pragma once

#include <array>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/view/colour/sensor_response.h"
#include "sim/view/sky/air.h"

namespace vegard::sim {

/// Photons cm^-2 s^-1 in the V band: 1.0e6 at magnitude 0.
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
