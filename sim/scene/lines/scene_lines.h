// The lines of a scene: those of emission_lines(), and its own, which go before them; and the blur that
// belongs to each.
#pragma once

#include <optional>
#include <vector>

#include "sim/scene/lines/emission_line.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The scene's own line within 0.05 nm of this wavelength, or nullptr.
const OwnLine* find_own_line(const Scene& scene, double wavelength_nm);

/// What is known of a line in this scene; none of a wavelength that neither list has. An own line that
/// follows another one comes from the same atoms, which lose as much by collisions; any other loses nothing
/// to them.
std::optional<EmissionLine> find_line(const Scene& scene, double wavelength_nm);

/// Standard deviation in degrees that a line gets if the scene says nothing: that of a default Scene for its
/// own lines and those that share a column of the tables with them (636.4 nm with 630.0 nm), none for the
/// others.
double default_blur_width_deg(double line_nm);

/// Sets the lines; a line that stays keeps its blur, a new one gets the default, of an own line that follows
/// another one that one's.
void change_lines(Scene& scene, const std::vector<double>& lines_nm);

}  // namespace vegard::sim
