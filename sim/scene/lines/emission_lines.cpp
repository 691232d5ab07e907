#include "sim/scene/lines/emission_lines.h"

#include <algorithm>
#include <cmath>

#include "sim/scene/lines/nebular_lines.h"
#include "sim/scene/lines/solar_lines.h"

namespace vegard::sim {
namespace {

std::vector<EmissionLine> all_lines() {
  std::vector<EmissionLine> lines = auroral_lines();
  for (const EmissionLine& line : nebular_lines()) lines.push_back(line);
  for (const EmissionLine& line : solar_lines()) lines.push_back(line);
  std::sort(lines.begin(), lines.end(),
            [](const EmissionLine& a, const EmissionLine& b) { return a.wavelength_nm < b.wavelength_nm; });
  for (EmissionLine& line : lines)
    if (line.components.empty()) line.components = {{line.wavelength_nm, 1.0}};
  return lines;
}

std::vector<double> wavelengths() {
  std::vector<double> lines;
  for (const EmissionLine& line : emission_lines()) lines.push_back(line.wavelength_nm);
  return lines;
}

}  // namespace

const std::vector<EmissionLine>& emission_lines() {
  static const std::vector<EmissionLine> lines = all_lines();
  return lines;
}

const EmissionLine* find_emission_line(double wavelength_nm) {
  for (const EmissionLine& line : emission_lines())
    if (std::abs(line.wavelength_nm - wavelength_nm) < kSameLineNm) return &line;
  return nullptr;
}

const std::vector<double>& known_emission_lines_nm() {
  static const std::vector<double> lines = wavelengths();
  return lines;
}

std::vector<LineComponent> line_components(double wavelength_nm) {
  const EmissionLine* line = find_emission_line(wavelength_nm);
  return line == nullptr ? std::vector<LineComponent>{{wavelength_nm, 1.0}} : line->components;
}

int line_index(const std::vector<double>& lines_nm, double line_nm) {
  const EmissionLine* line = find_emission_line(line_nm);
  for (std::size_t l = 0; l < lines_nm.size(); ++l)
    if (line != nullptr ? find_emission_line(lines_nm[l]) == line
                        : std::abs(lines_nm[l] - line_nm) < kSameLineNm)
      return static_cast<int>(l);
  return -1;
}

int line_in_angstrom(double line_nm) { return static_cast<int>(std::lround(line_nm * 10.0)); }

std::string line_name(double line_nm) { return std::to_string(line_in_angstrom(line_nm)); }

}  // namespace vegard::sim
