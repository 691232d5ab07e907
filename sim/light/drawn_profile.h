// The light of a sheet as a table has it: measured, from another model, or drawn.
#pragma once

#include <string>
#include <vector>

#include "sim/light/height_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The profile of sheet.profile_file: altitude_km and a column per line ("557.7", "5577" or "ver_5577"),
/// photons cm^-3 s^-1 at 1 mW m^-2. Straight lines between the rows, which keep what is drawn between its
/// neighbours and above 0, and dark beyond the first and the last. It does not depend on any energy. A line
/// that is not the electrons' (486.1 nm of protons) shines if it has a column.
///
/// Throws Error(unreadable_input), with the table's name, unless there are at least two rows of increasing
/// altitudes, none of the numbers of the lines asked for is negative, each of the electrons' lines has a
/// column, and the rows cover some of what the profile does.
HeightProfile drawn_profile(const std::vector<double>& wavelengths_nm, const Scene& scene,
                            const Sheet& sheet);

/// Whether the table has a column of this line. Throws as drawn_profile() does of a table that is none.
bool has_drawn_column(double wavelength_nm, const Scene& scene, const Sheet& sheet);

}  // namespace vegard::sim
