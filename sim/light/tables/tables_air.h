// The air for which emission tables were computed, with its properties that stop electrons.
//
// Source: the tables' own atmosphere.csv; that of data/glow is NRLMSISE-00 through GLOW (data/README.md). It
// is not the U.S. Standard Atmosphere of sim/light/atmosphere.h, which is for the excited atoms' collisions.
#pragma once

#include <vector>

#include "sim/base/file/csv_table.h"
#include "sim/light/tables/ionisation.h"

namespace vegard::sim {

/// Returns the air at the altitudes of the emission tables, from the bottom up, from the columns altitude_km,
/// T_K, nO, nO2 and nN2 (cm^-3) of a table. Throws Error(unreadable_input) unless the table has the same
/// altitudes, temperatures are above 0, densities are not negative, and no row is without air.
std::vector<StoppingAir> tables_air(const CsvTable& atmosphere, const std::vector<double>& altitudes_km);

}  // namespace vegard::sim
