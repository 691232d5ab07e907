// The light of one emission line along a field line, in the numbers that people publish.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// From the height profile of scene.sheets[sheet], in km of altitude.
struct LineLight {
  /// Of the largest volume emission rate, by the parabola through the three samples about it.
  double peak_km = 0.0;
  bool peak_at_an_end = false;  ///< of the profile: then it is no peak
  /// Below the peak, where the volume emission rate has fallen to a tenth of the peak's; NaN if it does not
  /// above the profile's bottom. Source of the tenth: docs/physics.md, row B19.
  double lower_border_km = 0.0;
  /// How far below and above its peak it has fallen to half; to the ends of the profile if it does not.
  double half_below_km = 0.0, half_above_km = 0.0;
  /// Rayleighs per mW m^-2 of all of the profile up to the sheet's top_km, seen vertically. Along the field
  /// every line's is longer by the same factor, so that ratios of lines are those along the field.
  double column_rayleigh = 0.0;
};

/// Throws what sheet_profile() throws; see has_line().
LineLight line_light(double wavelength_nm, const Scene& scene, int sheet);

/// Whether the sheet's height profile knows a line: a free form has the scene's lines and no others, a
/// table's columns are the user's.
bool has_line(double wavelength_nm, const Scene& scene, int sheet);

/// 557.7 nm where the sheet has it, else the line of the scene that has the largest column; 0 if there is
/// none.
double border_line_nm(const Scene& scene, int sheet);

/// "557.7 nm".
std::string line_words(double wavelength_nm);

}  // namespace vegard::sim
