// The air for which emission tables were made, as it stops electrons.
//
// Source: the tables' own atmosphere.csv; that of data/glow is NRLMSISE-00 through GLOW (data/README.md). It
// is not the U.S. Standard Atmosphere of sim/light/atmosphere.h, which has the excited atoms' collisions.
#pragma once

#include <vector>

#include "sim/base/file/csv_table.h"
#include "sim/light/tables/ionisation.h"

namespace vegard::sim {

/// At the altitudes of the emission tables, from the bottom up, out of the columns altitude_km, T_K, nO, nO2
/// and nN2 (cm^-3) of a table. Throws Error(unreadable_input) unless its altitudes are those, temperatures
/// are above 0 and densities not below, with some air everywhere.
std::vector<StoppingAir> tables_air(const CsvTable& atmosphere, const std::vector<double>& altitudes_km);

}  // namespace vegard::sim
