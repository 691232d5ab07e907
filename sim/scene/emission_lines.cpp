#include "sim/scene/emission_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "sim/base/embedded_table.h"

namespace vegard::sim {
namespace {

std::vector<double> read_lines() {
  const std::string_view table = embedded_table("ver_maxwellian.csv");
  std::string_view head = table.substr(0, table.find_first_of("\r\n"));
  std::vector<double> lines;
  while (!head.empty()) {
    const std::size_t comma = std::min(head.find(','), head.size());
    const std::string_view column = head.substr(0, comma);
    head.remove_prefix(std::min(comma + 1, head.size()));
    constexpr std::string_view prefix = "ver_";
    if (column.substr(0, prefix.size()) != prefix) continue;
    int angstrom = 0;
    std::from_chars(column.data() + prefix.size(), column.data() + column.size(), angstrom);
    lines.push_back(angstrom / 10.0);
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

double width_of(const Scene& scene, double line_nm, double otherwise) {
  const auto& lines = scene.emission.lines;
  const auto found = std::find(lines.begin(), lines.end(), line_nm);
  const auto index = static_cast<std::size_t>(found - lines.begin());
  return index < scene.blur.width_deg.size() ? scene.blur.width_deg[index] : otherwise;
}

}  // namespace

const std::vector<double>& known_emission_lines_nm() {
  static const std::vector<double> lines = read_lines();
  return lines;
}

double default_blur_width_deg(double line_nm) { return width_of(Scene{}, line_nm, 0.0); }

void change_lines(Scene& scene, const std::vector<double>& lines_nm) {
  std::vector<double> widths;
  for (const double line : lines_nm) widths.push_back(width_of(scene, line, default_blur_width_deg(line)));
  scene.emission.lines = lines_nm;
  scene.blur.width_deg = widths;
}

std::string line_name(double line_nm) { return std::to_string(std::lround(line_nm * 10.0)); }

}  // namespace vegard::sim
