// An emission line that the scene's file defines: plain numbers, as in sim/scene/structs/scene.h.
#pragma once

#include <string>

namespace vegard::sim {

/// Smallest scale height of a layer: the steps of altitude cannot resolve a thinner one.
inline constexpr double kThinnestLayer_km = 0.5;

/// [[line]]: a line that emission_lines() lacks, or has with other numbers. Its light comes from a column of
/// a sheet's profile file; else it is `ratio` times the photons of the line follows_nm; else it fills a layer
/// with its own height and thickness (sim/light/own_light.h).
struct OwnLine {
  std::string name = "line";
  double wavelength_nm = 486.1;
  double lifetime_s = 0.0;          ///< of the upper state, without collisions
  double follows_nm = 0.0;          ///< a line of the emission tables; 0: none
  double ratio = 1.0;               ///< photons for each photon of that line
  double rayleigh_per_mw_m2 = 0.0;  ///< brightness of its layer from straight below; 0: no layer
  double peak_km = 120.0;           ///< of its layer
  double scale_height_km = 0.0;     ///< of its layer; 0: that of the body's air
};

}  // namespace vegard::sim
