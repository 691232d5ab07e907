#include "sim/light/drawn_profile.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>

#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/text.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/scene/rows/spline_rates.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/table_files.h"

namespace vegard::sim {
namespace {

const std::string kDrawnAltitude = "altitude_km";

Error table_error(const CsvTable& table, const std::string& problem) {
  return unreadable(table.name, problem);
}

/// Returns the wavelength that a column's name says, in nm or, above 2000, in angstrom.
std::optional<double> wavelength_in(std::string_view name) {
  constexpr std::string_view kPrefix = "ver_";
  if (name.substr(0, kPrefix.size()) == kPrefix) name.remove_prefix(kPrefix.size());
  double number = 0.0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc() || end != name.data() + name.size()) return std::nullopt;
  constexpr double kMinAngstrom = 2000.0;
  return number >= kMinAngstrom ? number / 10.0 : number;
}

/// Returns the name of a wavelength's column; empty if there is none.
std::string column_if_any(const CsvTable& table, double wavelength_nm) {
  std::string found;
  for (const std::string& name : table.columns) {
    const std::optional<double> wavelength = wavelength_in(name);
    if (!wavelength || std::abs(*wavelength - wavelength_nm) >= 0.05) continue;
    if (!found.empty())
      throw table_error(table, "the columns '" + found + "' and '" + name + "' are both of " +
                                   short_real_text(wavelength_nm) + " nm")
          .expected("one column per line");
    found = name;
  }
  return found;
}

Error no_column(const CsvTable& table, double wavelength_nm) {
  return table_error(table, "there is no column of " + short_real_text(wavelength_nm) + " nm beside " +
                                joined(table.columns))
      .expected("one called '" + line_name(wavelength_nm) + "' or '" + short_real_text(wavelength_nm) + "'")
      .hint("a line without light has a column of zeros");
}

CsvTable read_table(const Scene& scene, const Sheet& sheet) {
  CsvTable table = read_csv_table(table_text(scene, "sheet." + sheet.name + ".profile_file"),
                                  table_place(scene, sheet.profile_file));
  table.require_increasing(kDrawnAltitude);
  if (table.rows() < 2)
    throw table_error(table, "a single row is no profile").expected("two altitudes at least");
  const std::vector<double>& altitude = table.column(kDrawnAltitude);
  if (altitude.back() <= HeightProfile::kBottomKm || altitude.front() >= HeightProfile::kTopKm)
    throw table_error(table, "the altitudes are all outside of the light's")
        .expected("some between 80 and 640 km");
  return table;
}

/// Interpolates linearly between the rows; returns 0 beyond them.
double rate_at(const std::vector<double>& altitudes, const std::vector<double>& rates, double altitude) {
  if (altitude < altitudes.front() || altitude > altitudes.back()) return 0.0;
  const auto above = std::upper_bound(altitudes.begin() + 1, altitudes.end() - 1, altitude);
  const auto i = static_cast<std::size_t>(above - altitudes.begin());
  const double share = (altitude - altitudes[i - 1]) / (altitudes[i] - altitudes[i - 1]);
  return rates[i - 1] + (rates[i] - rates[i - 1]) * share;
}

bool may_shine(const Scene& scene, double wavelength_nm) {
  const auto line = find_line(scene, wavelength_nm);
  return line && is_auroral(*line);
}

}  // namespace

HeightProfile drawn_profile(const std::vector<double>& wavelengths_nm, const Scene& scene,
                            const Sheet& sheet) {
  const CsvTable table = read_table(scene, sheet);
  HeightProfile profile = dark_profile(static_cast<int>(wavelengths_nm.size()));
  for (int l = 0; l < profile.lines; ++l) {
    const std::string column = column_if_any(table, wavelengths_nm[l]);
    const EmissionLine* line = find_emission_line(wavelengths_nm[l]);
    if (column.empty() && (line == nullptr || !is_auroral(*line))) continue;  // of something else
    if (column.empty()) throw no_column(table, wavelengths_nm[l]);
    table.require_within(column, 0.0, std::numeric_limits<float>::max());
    for (int a = 0; a < HeightProfile::kAltitudes; ++a)
      profile.rate[static_cast<std::size_t>(a) * profile.stride + l] = static_cast<float>(
          rate_at(table.column(kDrawnAltitude), table.column(column), HeightProfile::altitude_km(a)));
  }
  return profile;
}

bool has_drawn_column(double wavelength_nm, const Scene& scene, const Sheet& sheet) {
  return !column_if_any(read_table(scene, sheet), wavelength_nm).empty();
}

HeightProfile spline_profile(const std::vector<double>& wavelengths_nm, const Scene& scene,
                             const Sheet& sheet) {
  const AltitudeSpline spline = altitude_spline(sheet);
  const auto& lines = scene.emission.lines;
  assert(sheet.spline_rate.size() == lines.size() * static_cast<std::size_t>(spline.count()));
  HeightProfile profile = dark_profile(static_cast<int>(wavelengths_nm.size()));
  std::vector<bool> shines;
  for (const double nm : wavelengths_nm) shines.push_back(may_shine(scene, nm));
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    const AltitudeSpline::Local local = spline.at(HeightProfile::altitude_km(a));
    for (int l = 0; l < profile.lines; ++l) {
      const int line = line_index(lines, wavelengths_nm[l]);
      if (line < 0 || !shines[l]) continue;
      const int first = spline_rate_index(sheet, line, local.first);
      double rate = 0.0;
      for (int k = 0; k < local.count; ++k) rate += sheet.spline_rate[first + k] * local.value[k];
      profile.rate[static_cast<std::size_t>(a) * profile.stride + l] = static_cast<float>(rate);
    }
  }
  return profile;
}

std::vector<float> spline_slope(const std::vector<double>& wavelengths_nm, const Scene& scene,
                                const Sheet& sheet, int index) {
  const AltitudeSpline spline = altitude_spline(sheet);
  HeightProfile slope = dark_profile(static_cast<int>(wavelengths_nm.size()));
  const int line = index / spline.count();
  for (int l = 0; l < slope.lines; ++l) {
    if (line_index(scene.emission.lines, wavelengths_nm[l]) != line) continue;
    if (!may_shine(scene, wavelengths_nm[l])) continue;
    for (int a = 0; a < HeightProfile::kAltitudes; ++a)
      slope.rate[static_cast<std::size_t>(a) * slope.stride + l] =
          static_cast<float>(spline.basis(index % spline.count(), HeightProfile::altitude_km(a)));
  }
  return slope.rate;
}

}  // namespace vegard::sim
