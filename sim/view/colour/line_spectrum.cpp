#include "sim/view/colour/line_spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/table/table_files.h"

namespace vegard::sim {
namespace line_spectrum {

constexpr double kStepNm = 5.0;

CsvTable table_of(const Scene& scene, const OwnLine& own) {
  CsvTable table = read_csv_table(table_text(scene, "line." + own.name + ".spectrum_file"),
                                  table_place(scene, own.spectrum_file));
  table.require_increasing("wavelength_nm");
  table.require_within("wavelength_nm", 10.0, 30000.0);
  table.require_within("photons", 0.0, 1e30);
  const std::vector<double>& photons = table.column("photons");
  const bool is_dark = std::all_of(photons.begin(), photons.end(), [](double p) { return p == 0.0; });
  if (is_dark || table.rows() < 2)
    throw unreadable(table.name, is_dark ? "the spectrum has no light" : "one row is no continuum")
        .key("line." + own.name + ".spectrum_file")
        .expected("two rows or more, with photons above 0");
  return table;
}

std::vector<LineComponent> components_of(const CsvTable& table) {
  const std::vector<double>&nm = table.column("wavelength_nm"), &photons = table.column("photons");
  std::vector<LineComponent> components;
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < nm.size(); ++i) {
    const double width = nm[i + 1] - nm[i];
    const int steps = static_cast<int>(std::ceil(width / kStepNm));
    for (int s = 0; s < steps; ++s) {
      const double t = (s + 0.5) / steps;
      components.push_back(
          {nm[i] + t * width, ((1.0 - t) * photons[i] + t * photons[i + 1]) * width / steps});
      sum += components.back().share;
    }
  }
  for (LineComponent& component : components) component.share /= sum;
  return components;
}

}  // namespace line_spectrum

std::vector<LineComponent> components_of_line(const Scene& scene, double wavelength_nm) {
  const OwnLine* own = find_own_line(scene, wavelength_nm);
  if (own == nullptr || own->spectrum_file.empty()) return line_components(wavelength_nm);
  return line_spectrum::components_of(line_spectrum::table_of(scene, *own));
}

}  // namespace vegard::sim
