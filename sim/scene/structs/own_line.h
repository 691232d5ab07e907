// A line of the scene's own: plain numbers, as in sim/scene/structs/scene.h.
#pragma once

#include <string>

namespace vegard::sim {

/// Layers of a smaller scale height are thinner than the steps of altitude can have.
inline constexpr double kThinnestLayer_km = 0.5;

/// [[line]]: a line that emission_lines() lacks, or has with other numbers. How it shines: by a column of a
/// sheet's profile file; else as `ratio` photons for each of the line that it follows; else in a layer of its
/// own (sim/light/own_light.h).
struct OwnLine {
  std::string name = "line";
  double wavelength_nm = 486.1;
  double lifetime_s = 0.0;          ///< of the upper state, without collisions
  double follows_nm = 0.0;          ///< a line of the emission tables; 0: none
  double ratio = 1.0;               ///< photons for each photon of that line
  double rayleigh_per_mw_m2 = 0.0;  ///< of its layer, seen from straight below; 0: it has none
  double peak_km = 120.0;           ///< of its layer
  double scale_height_km = 0.0;     ///< of its layer; 0: that of the body's air
};

}  // namespace vegard::sim
