// The output of `vegard electrons`: a table of rates by altitude, and text about the energy budget.
#pragma once

#include <string>
#include <vector>

#include "sim/light/transport/electron_transport.h"

namespace vegard::apps {

/// The request in words, and the ionisation by the formula of Fang et al. 2010 at the column's altitudes
/// (empty if the electrons are not isotropic or the field is not vertical).
struct ElectronRun {
  std::string electrons;   ///< "Maxwellian, E0 5 keV, 1 mW m^-2, isotropic"
  std::string atmosphere;  ///< "U.S. Standard Atmosphere 1976"
  std::vector<double> fang_cm3_s;
};

/// Returns CSV with a row per altitude from the bottom up: altitude_km, ion pairs (all, of each gas, Fang's),
/// energy, and a column for each excitation and ionised shell.
std::string electron_rates_csv(const ElectronRun& run, const sim::FieldAir& column,
                               const sim::ElectronRates& rates);

/// Returns lines of text: the energy budget, eV per ion pair, the peak, and the comparison with Fang's
/// formula.
std::string electron_budget_text(const ElectronRun& run, const sim::FieldAir& column,
                                 const sim::ElectronRates& rates);

/// The same as JSON.
std::string electron_budget_json(const ElectronRun& run, const sim::FieldAir& column,
                                 const sim::ElectronRates& rates);

}  // namespace vegard::apps
