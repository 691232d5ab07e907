#include "sim/scene/file/curve_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/text.h"

namespace vegard::sim {
namespace {

constexpr std::array<const char*, 6> kCurtainColumns = {"curtain",           "east_km",    "north_km",
                                                        "energy_flux_mw_m2", "energy_kev", "width_km"};
constexpr double kMinBrightness = 1e-6;  // of point_brightness

/// The table with no other columns: what stands in those need be no number. Lines stay where they are; one
/// with too few cells is left as it is, for whoever reads numbers to complain of.
std::string with_own_columns(std::string_view text) {
  std::vector<std::size_t> own;
  bool has_names = false;
  std::string kept;
  if (text.substr(0, 3) == "\xef\xbb\xbf") text.remove_prefix(3);
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') {
      kept += '\n';
      continue;
    }
    const std::vector<std::string_view> cells = split(line, ',');
    if (!has_names) {
      has_names = true;
      for (std::size_t c = 0; c < cells.size(); ++c)
        if (std::find(kCurtainColumns.begin(), kCurtainColumns.end(), trimmed(cells[c])) !=
            kCurtainColumns.end())
          own.push_back(c);
      if (own.empty()) return std::string(line);
    }
    std::string some;
    for (const std::size_t c : own)
      if (c < cells.size()) some.append(some.empty() ? "" : ",").append(cells[c]);
    kept.append(own.back() < cells.size() ? some : std::string(content)).append("\n");
  }
  return kept;
}

}  // namespace

void take_curtain(std::string_view text, const std::string& file, int curtain, bool keeps_flux,
                  Sheet& sheet) {
  const CsvTable table = read_csv_table(with_own_columns(text), file);
  for (const char* column : kCurtainColumns) table.column(column);
  std::vector<std::size_t> rows;
  double last = 0.0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double which = table.column("curtain")[row];
    last = std::max(last, which);
    if (which == curtain) rows.push_back(row);
  }
  if (rows.empty())
    throw unreadable(file, "there is no curtain " + std::to_string(curtain) + " in '" + file + "'")
        .expected(last >= 1.0 ? "curve = 1 to " + std::to_string(static_cast<int>(std::min(last, 1e9)))
                              : "curtains that count from 1");
  double most = 0.0;
  for (const std::size_t row : rows) {
    const double flux = table.column("energy_flux_mw_m2")[row];
    if (flux < 0.0)
      throw unreadable(file, "energy_flux_mw_m2 is below 0")
          .line(table.lines[row])
          .expected("an energy flux of at least 0");
    most = std::max(most, flux);
  }
  if (!(most > 0.0))
    throw unreadable(file, "curtain " + std::to_string(curtain) + " has no light")
        .expected("energy_flux_mw_m2 above 0");
  sheet.course = SheetCourse::curve;
  for (std::vector<double>* list : {&sheet.east_km, &sheet.north_km, &sheet.point_brightness,
                                    &sheet.point_energy_kev, &sheet.point_width_km})
    list->clear();
  for (const std::size_t row : rows) {
    sheet.east_km.push_back(table.column("east_km")[row]);
    sheet.north_km.push_back(table.column("north_km")[row]);
    sheet.point_brightness.push_back(std::max(kMinBrightness, table.column("energy_flux_mw_m2")[row] / most));
    sheet.point_energy_kev.push_back(table.column("energy_kev")[row]);
    sheet.point_width_km.push_back(table.column("width_km")[row]);
  }
  if (!keeps_flux) sheet.energy_flux_mw_m2 = most;
}

}  // namespace vegard::sim
