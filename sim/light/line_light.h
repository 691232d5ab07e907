// The usual published numbers of one emission line of a sheet: peak altitude, lower border, width and column
// brightness.
#pragma once

#include <string>

namespace vegard::sim {

struct Scene;

/// Numbers of one line in the height profile of a sheet. Altitudes and distances are vertical, in km.
struct LineLight {
  /// Altitude of the largest volume emission rate, by the parabola through the three samples about it.
  double peak_km = 0.0;
  bool peak_at_an_end = false;  ///< the maximum is at an end of the profile, so that it is no true peak
  /// Altitude below the peak at which the volume emission rate has fallen to a tenth of the peak's; NaN if it
  /// does not fall so far within the profile. Source of the tenth: docs/physics.md, row B19.
  double lower_border_km = 0.0;
  /// Distances below and above the peak at which the rate has fallen to half; if it does not, the distances
  /// to the ends of the profile.
  double half_below_km = 0.0, half_above_km = 0.0;
  /// Column brightness, R per mW m^-2, of the profile up to the sheet's top_km, seen vertically. Along the
  /// field the columns of all lines are longer by the same factor, so that their ratios are the same.
  double column_rayleigh = 0.0;
};

/// Returns the numbers of a line in the height profile of scene.sheets[sheet], which must have the line; see
/// has_line(). Throws what sheet_profile() throws.
LineLight line_light(double wavelength_nm, const Scene& scene, int sheet);

/// True if the sheet's height profile has the line: a free-form profile has the scene's lines only, a profile
/// from a table has the lines of the table's columns.
bool has_line(double wavelength_nm, const Scene& scene, int sheet);

/// Returns the line whose lower border is reported: 557.7 nm if the sheet has it, else the line of the scene
/// with the largest column; 0 if there is none.
double border_line_nm(const Scene& scene, int sheet);

/// Returns a line's name, "557.7 nm".
std::string line_words(double wavelength_nm);

}  // namespace vegard::sim
