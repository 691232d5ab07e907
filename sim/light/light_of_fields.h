// From rayleighs along a path to light in space, as LightField gives it.
#pragma once

namespace vegard::sim {

inline constexpr double kCmPerKm = 1e5;
inline constexpr double kPhotonsPerRayleigh_cm2_s = 1e6;  ///< through a column, to all sides

/// Photons cm^-3 s^-1 of what adds so many rayleighs to a path of one unit.
inline double photons_per_volume(double rayleigh, double unit_cm) {
  return rayleigh * kPhotonsPerRayleigh_cm2_s / unit_cm;
}

}  // namespace vegard::sim
