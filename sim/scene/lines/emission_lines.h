// Emission lines: their properties, and the list of all that a scene may name, those of aurora, nebulae and
// the Sun.
//
// Most auroral lines have a column of their own in the emission tables (sim/light/tables/emission_tables.h).
// The light of the others is that of another column times `ratio`, because both lines have the same upper
// state or because the literature gives a ratio. The lines of nebulae have no column: electrons in the air do
// not excite them. docs/lines.md has the list.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vegard::sim {

/// The green line of oxygen, the reference for brightnesses.
inline constexpr double kGreenNm = 557.7;

/// One wavelength of a line (a multiplet or a set of bands has several), and its share of the photons.
struct LineComponent {
  double wavelength_nm;
  double share;
};

struct EmissionLine {
  double wavelength_nm = 0.0;  ///< identifies the line; of a set of bands: of one of them
  const char* species = "";
  const char* transition = "";
  double lifetime_s = 0.0;                ///< of the upper state, without collisions
  const char* table_column = "";          ///< column in tables without one for this line; empty: not auroral
  double ratio = 0.0;                     ///< its photons over those of table_column
  const char* ratio_source = "";          ///< reference and spread; empty: it has its own column
  const char* blended_with = "";          ///< lines that a filter of some nm width does not separate
  std::vector<LineComponent> components;  ///< shares add up to 1; one component for a single line
  const char* components_source = "";     ///< reference for the shares; empty for a single line
  bool is_own = false;                    ///< from [[line]] (sim/scene/lines/scene_lines.h)
};

/// True if electrons in the air excite the line. The other lines are of nebulae and the Sun; in an aurora
/// they need a height profile of the user.
bool is_auroral(const EmissionLine& line);

/// Returns the auroral lines: lines and bands of oxygen and nitrogen.
std::vector<EmissionLine> auroral_lines();

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

/// Returns the recombination lines of hydrogen and helium, forbidden lines of ions (as doublets where both
/// lines have a common upper term and thus a fixed ratio), starlight scattered by dust, and synchrotron
/// light.
std::vector<EmissionLine> nebular_lines();

/// Returns the continuum of STEVE, which shines south of the aurora without electrons falling.
std::vector<EmissionLine> subauroral_lines();

/// True if the line is one of subauroral_lines().
bool is_subauroral(const EmissionLine& line);

/// Light of a line as a function of the temperature of the plasma, relative to its maximum:
///   exp(-1/2 ((log10 T - peak_log_k) / width_log_k)²).
/// It approximates the line's contribution function, which peaks where the line's ion is most abundant in
/// ionisation equilibrium. The full width at half maximum, 2.35 width_log_k, is 0.2 to 0.4 in log10 T.
struct TemperatureResponse {
  double peak_log_k, width_log_k;
  const char* source;  ///< reference for the peak
};

/// Returns the bands of solar pictures: ultraviolet lines of the corona, two visible lines of the corona, and
/// white light.
std::vector<EmissionLine> solar_lines();

/// Returns nothing for white light, which free electrons scatter at any temperature, and for other lines.
std::optional<TemperatureResponse> temperature_response(double wavelength_nm);

/// True if the line is one of solar_lines().
bool is_solar(const EmissionLine& line);

}  // namespace vegard::sim
