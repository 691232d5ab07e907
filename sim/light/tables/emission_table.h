// An emission table: volume emission rates against altitude and the energy of electrons, from one file of a
// folder of tables.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/base/file/csv_table.h"
#include "sim/base/number/spline.h"

namespace vegard::sim {

/// A rate and its derivatives by the logarithms of the electrons' energy and of the factor of atomic oxygen.
struct Emission1d {
  double rate = 0.0;  ///< photons cm^-3 s^-1 at Q = 1 mW m^-2
  double d_rate_d_ln_energy = 0.0;
  double d_rate_d_ln_oxygen = 0.0;
};

/// A table such as data/glow/ver_maxwellian.csv (Solomon 2017, doi:10.1002/2017JA024314): Q = 1 mW m^-2,
/// background subtracted. Between the tabulated energies log(rate) is a natural cubic spline in log(E);
/// rates below 1e-6 of a line's peak at that energy are raised to this value, so that the logarithm exists.
/// Between factors of atomic oxygen log(rate) is a natural cubic spline in log(factor).
class EmissionTable {
 public:
  /// Reads a table with the columns oxygen_factor (optional; 1 if missing), `energy_column` and altitude_km;
  /// all other columns are rates. Rows are ordered by factor, then energy, then altitude, with the same
  /// energies and altitudes throughout. Throws Error(unreadable_input) with the row unless all rows are
  /// present in this order, factors (16 at most, one of them 1), energies and altitudes increase, and no rate
  /// is negative.
  explicit EmissionTable(const CsvTable& table, const std::string& energy_column = "E0_keV");

  const std::vector<double>& energies_kev() const { return energies_kev_; }
  const std::vector<double>& altitudes_km() const { return altitudes_km_; }
  const std::vector<double>& oxygen_factors() const { return factors_; }
  bool has(const std::string& column) const { return log_rate_.count(column) > 0; }
  std::vector<std::string> columns() const;  ///< of rates, in alphabetical order

  /// Returns the rate at every tabulated altitude, for one column ("ver_5577") and one energy, which must be
  /// inside the table's range.
  std::vector<Emission1d> at_energy(const std::string& column, double energy_kev,
                                    double oxygen_factor = 1.0) const;

 private:
  void read_places(const CsvTable& table, const std::string& energy_column);
  void read_rates(const CsvTable& table, std::size_t column);

  std::vector<double> factors_, energies_kev_, log_energies_, altitudes_km_;
  std::map<std::string, std::vector<double>>
      log_rate_;  ///< [(factor * altitudes + altitude) * energies + energy]
  std::map<std::string, std::vector<double>> log_curvature_;  ///< likewise, of the splines in log energy
};

/// Returns the weights by which values at `factors` are interpolated at `factor`: a natural cubic spline in
/// ln(factor) is linear in its values. SplineValue::slope is the derivative of the weight by ln(factor).
/// Beyond the factors the spline continues linearly, that is, rates as a power law. For a single factor {1,
/// 0}.
std::vector<SplineValue> oxygen_weights(const std::vector<double>& factors, double factor);

}  // namespace vegard::sim
