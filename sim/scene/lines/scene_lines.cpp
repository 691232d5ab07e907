#include "sim/scene/lines/scene_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {
namespace {

double width_of(const Scene& scene, double line_nm, double otherwise) {
  const auto& lines = scene.emission.lines;
  const auto found = std::find(lines.begin(), lines.end(), line_nm);
  const auto index = static_cast<std::size_t>(found - lines.begin());
  return index < scene.blur.width_deg.size() ? scene.blur.width_deg[index] : otherwise;
}

}  // namespace

const OwnLine* find_own_line(const Scene& scene, double wavelength_nm) {
  for (const OwnLine& own : scene.own_lines)
    if (std::abs(own.wavelength_nm - wavelength_nm) < kSameLineNm) return &own;
  return nullptr;
}

std::optional<EmissionLine> find_line(const Scene& scene, double wavelength_nm) {
  const OwnLine* own = find_own_line(scene, wavelength_nm);
  const EmissionLine* listed = find_emission_line(own == nullptr ? wavelength_nm : own->follows_nm);
  if (own == nullptr) return listed == nullptr ? std::nullopt : std::optional<EmissionLine>(*listed);
  EmissionLine line = listed == nullptr ? EmissionLine{} : *listed;
  line.wavelength_nm = own->wavelength_nm;
  line.lifetime_s = own->lifetime_s;
  line.components = {{own->wavelength_nm, 1.0}};
  line.is_own = true;
  return line;
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
  for (const double line : lines_nm) {
    const OwnLine* own = find_own_line(scene, line);
    const double like_nm = own != nullptr && own->follows_nm > 0.0 ? own->follows_nm : line;
    widths.push_back(width_of(scene, line, default_blur_width_deg(like_nm)));
  }
  scene.emission.lines = lines_nm;
  scene.blur.width_deg = widths;
}

}  // namespace vegard::sim
