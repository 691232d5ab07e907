// The wavelengths of a scene's line: those of sim/scene/lines/emission_lines.h, or of a continuum that the
// user gives as a table ([[line]] spectrum_file).
#pragma once

#include <vector>

#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {

struct Scene;

/// Returns the components of a line of the scene. A continuum of the user is linear between the rows of its
/// table and has components in the middles of steps of at most 5 nm, as fine as the tables of the observer.
/// Throws Error(unreadable_input), with file and line, for a table without the columns wavelength_nm,
/// increasing within 10 to 30000, and photons, of at least two rows, none negative and not all 0.
std::vector<LineComponent> components_of_line(const Scene& scene, double wavelength_nm);

}  // namespace vegard::sim
