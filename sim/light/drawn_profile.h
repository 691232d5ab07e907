// Height profiles of a sheet that do not come from electrons: from a user's table (measured, from another
// model, or drawn by hand), and free forms, for each line a cubic B-spline in altitude whose coefficients are
// parameters.
#pragma once

#include <string>
#include <vector>

#include "sim/light/height_profile.h"

namespace vegard::sim {

struct Scene;
struct Sheet;

/// Returns the profile of sheet.profile_file. The table has a column altitude_km and a column per line
/// ("557.7", "5577" or "ver_5577"), in photons cm^-3 s^-1 at 1 mW m^-2. Interpolation between the rows is
/// linear, so that values never overshoot or become negative; the profile is dark beyond the first and the
/// last row. It does not depend on the electrons' energy. A line that electrons do not excite (486.1 nm, from
/// protons) has light if the table has a column for it.
///
/// Throws Error(unreadable_input), with the table's name, unless the table has at least two rows of
/// increasing altitudes, no negative number in the columns of `wavelengths_nm`, a column for each of these
/// lines that electrons excite, and rows that overlap the altitudes of a HeightProfile.
HeightProfile drawn_profile(const std::vector<double>& wavelengths_nm, const Scene& scene,
                            const Sheet& sheet);

/// True if the table has a column for this line. Throws like drawn_profile() if the file is not such a table.
bool has_drawn_column(double wavelength_nm, const Scene& scene, const Sheet& sheet);

/// Returns the profile rate = sum of c_k B_k(altitude), with c the line's Sheet::spline_rate and B the basis
/// functions of sim/base/number/altitude_spline.h. The coefficients are positive, hence so is the rate; the
/// electrons' energy has no effect. A line that the scene does not have is dark.
HeightProfile spline_profile(const std::vector<double>& wavelengths_nm, const Scene& scene,
                             const Sheet& sheet);

/// Returns d rate / d coefficient, indexed as HeightProfile::rate: the coefficient's basis function for its
/// line, 0 for the other lines. `index`: of the coefficient in Sheet::spline_rate.
std::vector<float> spline_slope(const std::vector<double>& wavelengths_nm, const Scene& scene,
                                const Sheet& sheet, int index);

}  // namespace vegard::sim
