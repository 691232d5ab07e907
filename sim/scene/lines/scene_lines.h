// The lines of a scene: its own ([[line]]), which take precedence, and those of emission_lines(); and the
// blur of each line.
#pragma once

#include <optional>
#include <vector>

#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the scene's own line within kSameLineNm of this wavelength, or nullptr.
const OwnLine* find_own_line(const Scene& scene, double wavelength_nm);

/// Returns the properties of a line in this scene; nothing if neither list has the wavelength. An own line
/// that follows another one has the same atoms and the same quenching; any other own line is not quenched.
std::optional<EmissionLine> find_line(const Scene& scene, double wavelength_nm);

/// Returns the default standard deviation of a line's blur in degrees: that of a default Scene for its lines
/// and for lines with the same column of the tables (636.4 nm as 630.0 nm); 0 for others.
double default_blur_width_deg(double line_nm);

/// Sets emission.lines and blur.width_deg. A line that was there keeps its blur, a new one gets the default;
/// an own line that follows another one gets the default of that one.
void change_lines(Scene& scene, const std::vector<double>& lines_nm);

}  // namespace vegard::sim
