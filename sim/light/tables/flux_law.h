// The dependence of a line's light on the energy flux Q of Maxwellian electrons, which is nearly
// proportional. The light per mW m^-2 relative to that at 1 mW m^-2 is
//
//     f(E0, Q) = (C(E0, Q) - B) / (Q (C(E0, 1) - B)),
//
// with C the column brightness in the tables' linearity_Q.csv (a model at Q = 0.1, 1 and 10) and B the
// background at zero flux, which C includes: the difference between linearity_Q.csv and column_brightness.csv
// at 10 keV and Q = 1 (for data/glow: 57.3 R at 630.0, 11.1 R at 557.7, 2.4 R at 520.0, 0.8 R at 777.4 nm). B
// is 0 if the two agree to the five digits of the latter, as for the prompt lines, whose f is 1, and if the
// latter has no such column.
//
// ln f is a natural cubic spline in ln Q through the three fluxes; its values there are natural cubic splines
// in ln E0. Beyond 0.1 and 10 it continues with the slope at the end and levels out, as slope *
// tanh(ln(Q/10)): nothing is known there, and ln f changes by no more than over one further factor of e. All
// first derivatives are continuous. Only columns are known: changes of the height profile's shape with Q are
// neglected.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/base/file/csv_table.h"

namespace vegard::sim {

struct FluxFactor {
  double log_factor = 0.0;  ///< ln f
  double by_log_energy = 0.0;
  double by_log_flux = 0.0;  ///< 0 at a flux of 0
};

class FluxFactors {
 public:
  /// Reads the law for `columns` of the emission tables ("ver_5577") from two tables: `brightness` with
  /// columns E0_keV, R_5577 and so on, and `linearity` with Q_erg, E0_keV, R_5577 and so on. Throws
  /// Error(unreadable_input) unless `linearity` has all columns, at fluxes of 0.1, 1 and 10 for the same
  /// increasing energies; both tables have 10 keV, if `brightness` has any of the columns; and no column is
  /// at or below its background.
  FluxFactors(const std::vector<std::string>& columns, const CsvTable& brightness, const CsvTable& linearity);

  /// Returns f for one of the columns; E0 must be inside the tables' range, the flux not negative.
  FluxFactor at(const std::string& column, double energy_kev, double energy_flux_mw_m2) const;

  /// Returns B, in rayleighs.
  double background_rayleigh(const std::string& column) const;

  /// Energies of linearity_Q.csv.
  const std::vector<double>& energies_kev() const { return energies_kev_; }

 private:
  struct FluxCurve {
    std::vector<double> log_factor, curvature;  ///< at the energies
  };
  struct ColumnLaw {
    double background_rayleigh = 0.0;
    FluxCurve at_low, at_high;
  };

  FluxCurve curve_of(const CsvTable& linearity, const std::string& name, double flux,
                     double background) const;

  std::vector<double> energies_kev_, log_energies_;
  std::map<std::string, ColumnLaw> laws_;
};

}  // namespace vegard::sim
