// How a line's light grows with the energy flux Q of Maxwellian electrons: nearly in proportion. The light
// per mW m^-2 relative to that at 1 mW m^-2 is
//
//     f(E0, Q) = (C(E0, Q) - B) / (Q (C(E0, 1) - B)),
//
// C the columns of the tables' linearity_Q.csv (a model at Q = 0.1, 1 and 10) and B the column at zero flux,
// which those still contain: what they have at 10 keV and Q = 1 beyond column_brightness.csv (of data/glow:
// 57.3 R of 630.0, 11.1 R of 557.7, 2.4 R of 520.0, 0.8 R of 777.4 nm; 0 where the two agree to the five
// digits of the latter, as for the prompt lines, whose f is 1, and where the latter has no such column).
//
// ln f is a natural cubic spline in ln Q through the three fluxes, whose values are natural cubic splines in
// ln E0. Beyond 0.1 and 10 it goes on with the slope it has there and levels out, as slope * tanh(ln(Q/10)):
// what happens there is not known, and f changes by no more than that of one further factor of e. All
// derivatives are continuous. Only columns are known: how the height profile changes with Q is left out.
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
  /// For `columns` of the emission tables ("ver_5577"), out of a table of E0_keV and R_5577 and so on, and
  /// one of Q_erg, E0_keV and the same. Throws Error(unreadable_input) unless the latter has all of them, at
  /// fluxes of 0.1, 1 and 10 for the same increasing energies; the former has 10 keV if it has any of them,
  /// which the latter must have too; and no column is at or below its background.
  FluxFactors(const std::vector<std::string>& columns, const CsvTable& brightness, const CsvTable& linearity);

  /// f of one of the columns; E0 inside the tables, flux not negative.
  FluxFactor at(const std::string& column, double energy_kev, double energy_flux_mw_m2) const;

  /// B, in rayleighs.
  double background_rayleigh(const std::string& column) const;

  /// Of linearity_Q.csv.
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
