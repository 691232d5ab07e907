// Volume emission rates against altitude and characteristic energy, from the GLOW tables.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace vegard::sim {

/// A rate and how it grows with the logarithm of the characteristic energy.
struct Emission1d {
  double rate = 0.0;  ///< photons cm^-3 s^-1 at Q = 1 mW m^-2
  double d_rate_d_ln_energy = 0.0;
};

/// The table of data/glow/ver_maxwellian.csv (Solomon 2017, doi:10.1002/2017JA024314): Maxwellian electrons,
/// Q = 1 mW m^-2, background subtracted. Between the tabulated energies log(rate) is a natural cubic spline
/// in log(E0); rates below 1e-6 of a line's peak at that energy are raised to it, so that the logarithm
/// exists.
class EmissionTable {
 public:
  /// The embedded table; parsed once.
  static const EmissionTable& glow();

  /// Parses a table of this form, energy by energy with the same altitudes; throws sim::Error or
  /// std::runtime_error on a malformed one (a damaged build, not a user's file).
  explicit EmissionTable(const std::string& csv);

  const std::vector<double>& energies_kev() const { return energies_kev_; }
  const std::vector<double>& altitudes_km() const { return altitudes_km_; }
  bool has(const std::string& column) const { return log_rate_.count(column) > 0; }

  /// The rate at every tabulated altitude, for one column ("ver_5577") and one energy inside the table's
  /// range.
  std::vector<Emission1d> at_energy(const std::string& column, double energy_kev) const;

 private:
  std::vector<double> energies_kev_, log_energies_, altitudes_km_;
  std::map<std::string, std::vector<double>> log_rate_;       ///< [altitude * energies + energy]
  std::map<std::string, std::vector<double>> log_curvature_;  ///< likewise, of the splines in log energy
};

}  // namespace vegard::sim
