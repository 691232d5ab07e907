// The one list of emission lines: which a scene may name, and the blur that belongs to each.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/lines/emission_line.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Every line, by increasing wavelength.
const std::vector<EmissionLine>& emission_lines();

/// The line within 0.05 nm of this wavelength, or nullptr.
const EmissionLine* find_emission_line(double wavelength_nm);

/// Wavelengths in nm of emission_lines(), ascending.
const std::vector<double>& known_emission_lines_nm();

/// Standard deviation in degrees that a line gets if the scene says nothing: that of a default Scene for its
/// own lines and those that share a column of the tables with them (636.4 nm with 630.0 nm), none for the
/// others.
double default_blur_width_deg(double line_nm);

/// Sets the lines; a line that stays keeps its blur, a new one gets the default.
void change_lines(Scene& scene, const std::vector<double>& lines_nm);

/// Which of `lines_nm` is the line of emission_lines() that `line_nm` names, or -1. Either may be written
/// with what find_emission_line() allows for.
int line_index(const std::vector<double>& lines_nm, double line_nm);

/// A line's wavelength in whole angstrom, by which paths tell lines apart.
int line_in_angstrom(double line_nm);

/// How a line is called in a path: its wavelength in angstrom, "6300".
std::string line_name(double line_nm);

}  // namespace vegard::sim
