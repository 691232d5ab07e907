// The airglow's layers: thin shells around the Earth that shine evenly.
#pragma once

#include <array>

#include "sim/base/earth.h"
#include "sim/base/number/dual.h"
#include "sim/view/sky/sky_numbers.h"

namespace vegard::sim {

/// A line of the airglow. Altitudes: Noll et al. 2025, doi:10.5194/gmd-18-4353-2025 (PALACE).
struct AirglowLayer {
  double wavelength_nm, altitude_km;
  SkyNumber brightness;  ///< rayleighs at the zenith, above the air
};

inline constexpr std::array<AirglowLayer, 3> kAirglowLayers = {
    {{557.7, 97.0, sky_green}, {630.0, 250.0, sky_red}, {589.3, 92.0, sky_sodium}}};

/// How much longer a slanted line of sight stays in a thin shell than one to the zenith (van Rhijn 1921,
/// Publ. Astron. Lab. Groningen 31): 1 / sqrt(1 - ((R + observer) / (R + shell))^2 cos^2 elevation). 0 for an
/// observer above the shell. T is double or a dual number over it.
template <class T>
T van_rhijn(const T& sine_of_elevation, double shell_km, double observer_km) {
  if (observer_km >= shell_km) return T(0.0);
  const double ratio = (kEarthRadiusKm + observer_km) / (kEarthRadiusKm + shell_km);
  return 1.0 / square_root((sine_of_elevation * sine_of_elevation - 1.0) * (ratio * ratio) + 1.0);
}

}  // namespace vegard::sim
