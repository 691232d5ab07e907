// The list of all emission lines that a scene may name.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/lines/emission_line.h"

namespace vegard::sim {

/// Returns all lines, by increasing wavelength.
const std::vector<EmissionLine>& emission_lines();

/// Wavelengths that differ by less than this name the same line.
inline constexpr double kSameLineNm = 0.05;

/// Returns the line within kSameLineNm of this wavelength, or nullptr.
const EmissionLine* find_emission_line(double wavelength_nm);

/// Returns the wavelengths of emission_lines() in nm, ascending.
const std::vector<double>& known_emission_lines_nm();

/// Returns the components of the line; for a wavelength that is not in the list, the wavelength itself.
std::vector<LineComponent> line_components(double wavelength_nm);

/// Returns the index in `lines_nm` of the line `line_nm`, or -1. Wavelengths match as in
/// find_emission_line().
int line_index(const std::vector<double>& lines_nm, double line_nm);

/// Returns a line's wavelength in whole angstrom, which identifies the line in paths.
int line_in_angstrom(double line_nm);

/// Returns a line's name in a path: its wavelength in angstrom, "6300".
std::string line_name(double line_nm);

}  // namespace vegard::sim
