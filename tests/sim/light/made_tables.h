// Emission tables that a test makes out of GLOW's: fewer rows of them, for several factors of atomic oxygen.
#pragma once

#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "sim/base/file/csv_table.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/emission_folder.h"

namespace vegard::tests {

/// ln(rate) grows with the logarithm of the oxygen factor by so much: otherwise at every altitude, and for
/// every column, so that no line's light only changes its amount.
inline double oxygen_power(std::size_t column, double altitude_km) {
  return 0.3 * std::sin(0.9 * static_cast<double>(column)) + 0.4 * std::tanh((altitude_km - 150.0) / 60.0);
}

/// A table of rates such as ver_maxwellian.csv as text, out of every sixth energy of GLOW's: a block for each
/// factor, whose rates are GLOW's times factor to oxygen_power() (at factors beyond 1.5 squared once more, so
/// that the spline between them has something to bend for).
inline std::string table_with_oxygen(const sim::CsvTable& table, const std::vector<double>& factors) {
  std::ostringstream text;
  text.precision(12);
  text << "oxygen_factor";
  for (const std::string& name : table.columns) text << "," << name;
  text << "\n";
  const std::vector<double>&energy = table.numbers[0], &altitude = table.numbers[1];
  for (const double factor : factors) {
    int number = -1;
    for (std::size_t r = 0; r < table.rows(); ++r) {
      if (r == 0 || energy[r] != energy[r - 1]) ++number;
      if (number % 6 != 0 && energy[r] != energy.back()) continue;
      text << factor << "," << energy[r] << "," << altitude[r];
      for (std::size_t c = 2; c < table.columns.size(); ++c) {
        const double power = oxygen_power(c, altitude[r]) * (factor > 1.5 ? 0.8 : 1.0);
        text << "," << table.numbers[c][r] * std::pow(factor, power);
      }
      text << "\n";
    }
  }
  return text.str();
}

/// The files of GLOW's tables, for a test to change.
inline sim::TableFolder glow_folder() { return *sim::built_in_tables("glow"); }

/// Of factors 0.5, 1 and 2; without a table of mono-energetic electrons.
inline sim::TableFolder folder_with_oxygen() {
  sim::TableFolder folder = glow_folder();
  folder.place = "made";
  std::string& text = folder.files.at(sim::kMaxwellianFile);
  text = table_with_oxygen(sim::read_csv_table(text, "ver_maxwellian.csv"), {0.5, 1.0, 2.0});
  return folder;
}

/// A scene whose tables these are.
inline void give_tables(sim::Scene& scene, const sim::TableFolder& folder) {
  scene.emission.tables = folder.place;
  scene.emission.folder = std::make_shared<const sim::TableFolder>(folder);
}

/// That of folder_with_oxygen(), once for all tests of a process.
inline void give_tables_with_oxygen(sim::Scene& scene) {
  static const auto folder = std::make_shared<const sim::TableFolder>(folder_with_oxygen());
  scene.emission.tables = folder->place;
  scene.emission.folder = folder;
}

}  // namespace vegard::tests
