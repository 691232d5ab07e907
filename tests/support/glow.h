// GLOW's emission tables, for tests whose figures are theirs; its own columns, and those of a table, for
// comparison.
#pragma once

#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "sim/base/file/csv_table.h"
#include "sim/base/number/spline.h"
#include "sim/light/height_profile.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/table/emission_folder.h"

namespace vegard::tests {

inline sim::EmissionSource glow() { return {sim::emission_tables("glow"), 1.0}; }

/// The text of one of the files of data/glow that make emission tables.
inline const std::string& glow_text(const std::string& file) {
  return sim::built_in_tables("glow")->files.at(file);
}
inline sim::CsvTable glow_table(const std::string& file) {
  return sim::read_csv_table(glow_text(file), "glow/" + file);
}

/// data/glow/column_brightness.csv: the model's full column in rayleighs, which the tables' makers summed on
/// the model's own grid. Its energies are those of the emission tables, rounded to five digits.
class GlowColumns {
 public:
  const std::vector<double>& energies_kev() const { return tests::glow().tables.maxwellian().energies_kev(); }

  /// In the order of the energies, for a wavelength such as 557.7.
  const std::vector<double>& rayleigh(double wavelength_nm) const {
    return table_.column("R_" + std::to_string(std::lround(wavelength_nm * 10.0)));
  }

  /// The natural cubic spline of ln(column) in ln(E0).
  sim::SplineValue log_at(double wavelength_nm, double energy_kev) const {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < energies_kev().size(); ++i) {
      x.push_back(std::log(energies_kev()[i]));
      y.push_back(std::log(rayleigh(wavelength_nm)[i]));
    }
    return sim::spline_at(x, y, sim::spline_curvature(x, y), std::log(energy_kev));
  }

  /// d ln(column) / d ln(E0) at an inner energy, by central differences.
  double difference(double wavelength_nm, std::size_t i) const {
    const std::vector<double>&e = energies_kev(), &r = rayleigh(wavelength_nm);
    return std::log(r[i + 1] / r[i - 1]) / std::log(e[i + 1] / e[i - 1]);
  }

 private:
  sim::CsvTable table_ = glow_table("column_brightness.csv");
};

/// The program's column in rayleighs, from 80 to 640 km.
inline sim::Column program_column(double wavelength_nm, double energy_kev) {
  return sim::column_below(sim::maxwellian_profile(tests::glow(), {wavelength_nm}, energy_kev), 0,
                           sim::HeightProfile::kTopKm);
}

/// The emission table without every second of its energies; the first and the last stay.
inline sim::EmissionTable every_second_energy() {
  std::istringstream text(glow_text("ver_maxwellian.csv"));
  std::string line, kept, last;
  std::getline(text, line);
  kept = line + "\n";
  int energy = -1;
  while (std::getline(text, line)) {
    const std::string key = line.substr(0, line.find(','));
    if (key != last) ++energy;
    last = key;
    if (energy % 2 == 0) kept += line + "\n";
  }
  return sim::EmissionTable(sim::read_csv_table(kept, "half.csv"));
}

/// A table's column in rayleighs, summed as the program sums it.
inline double column_of(const sim::EmissionTable& table, const std::string& column, double energy_kev) {
  const std::vector<double>& knots = table.altitudes_km();
  std::vector<double> log_rate;
  for (const sim::Emission1d& e : table.at_energy(column, energy_kev)) log_rate.push_back(std::log(e.rate));
  const std::vector<double> curvature = sim::spline_curvature(knots, log_rate);
  double sum = 0.0;
  for (int a = 0; a < sim::HeightProfile::kAltitudes; ++a) {
    const double end = a == 0 || a == sim::HeightProfile::kAltitudes - 1 ? 0.5 : 1.0;
    sum +=
        end * std::exp(sim::spline_at(knots, log_rate, curvature, sim::HeightProfile::altitude_km(a)).value);
  }
  return 0.1 * sim::HeightProfile::kStepKm * sum;
}

}  // namespace vegard::tests
