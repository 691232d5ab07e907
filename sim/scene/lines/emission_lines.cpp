#include "sim/scene/lines/emission_lines.h"

#include <algorithm>
#include <cmath>
#include <string_view>

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

double width_of(const Scene& scene, double line_nm, double otherwise) {
  const auto& lines = scene.emission.lines;
  const auto found = std::find(lines.begin(), lines.end(), line_nm);
  const auto index = static_cast<std::size_t>(found - lines.begin());
  return index < scene.blur.width_deg.size() ? scene.blur.width_deg[index] : otherwise;
}

}  // namespace

const std::vector<EmissionLine>& emission_lines() {
  static const std::vector<EmissionLine> lines = all_lines();
  return lines;
}

const EmissionLine* find_emission_line(double wavelength_nm) {
  for (const EmissionLine& line : emission_lines())
    if (std::abs(line.wavelength_nm - wavelength_nm) < 0.05) return &line;
  return nullptr;
}

const std::vector<double>& known_emission_lines_nm() {
  static const std::vector<double> lines = wavelengths();
  return lines;
}

double default_blur_width_deg(double line_nm) {
  const EmissionLine* line = find_emission_line(line_nm);
  const Scene scene;
  for (const double own_nm : scene.emission.lines) {
    const EmissionLine* own = find_emission_line(own_nm);
    if (line != nullptr && own != nullptr && std::string_view(line->table_column) == own->table_column)
      return width_of(scene, own_nm, 0.0);
  }
  return 0.0;
}

void change_lines(Scene& scene, const std::vector<double>& lines_nm) {
  std::vector<double> widths;
  for (const double line : lines_nm) widths.push_back(width_of(scene, line, default_blur_width_deg(line)));
  scene.emission.lines = lines_nm;
  scene.blur.width_deg = widths;
}

int line_index(const std::vector<double>& lines_nm, double line_nm) {
  const EmissionLine* line = find_emission_line(line_nm);
  for (std::size_t l = 0; line != nullptr && l < lines_nm.size(); ++l)
    if (find_emission_line(lines_nm[l]) == line) return static_cast<int>(l);
  return -1;
}

int line_in_angstrom(double line_nm) { return static_cast<int>(std::lround(line_nm * 10.0)); }

std::string line_name(double line_nm) { return std::to_string(line_in_angstrom(line_nm)); }

}  // namespace vegard::sim
