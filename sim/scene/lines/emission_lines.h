// The one list of emission lines that a scene may name.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/lines/emission_line.h"

namespace vegard::sim {

/// Every line, by increasing wavelength.
const std::vector<EmissionLine>& emission_lines();

/// Wavelengths that are less apart name one line.
inline constexpr double kSameLineNm = 0.05;

/// The line within kSameLineNm of this wavelength, or nullptr.
const EmissionLine* find_emission_line(double wavelength_nm);

/// Wavelengths in nm of emission_lines(), ascending.
const std::vector<double>& known_emission_lines_nm();

/// Where the line shines and with which shares: of one that the list lacks its wavelength alone.
std::vector<LineComponent> line_components(double wavelength_nm);

/// Which of `lines_nm` is the line that `line_nm` names, or -1. Either may be written with what
/// find_emission_line() allows for.
int line_index(const std::vector<double>& lines_nm, double line_nm);

/// A line's wavelength in whole angstrom, by which paths tell lines apart.
int line_in_angstrom(double line_nm);

/// How a line is called in a path: its wavelength in angstrom, "6300".
std::string line_name(double line_nm);

}  // namespace vegard::sim
