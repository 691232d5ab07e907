// The height profile of a sheet from a user's table: measured, from another model, or drawn by hand.
#pragma once

#include <string>
#include <vector>

#include "sim/light/height_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

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

}  // namespace vegard::sim
