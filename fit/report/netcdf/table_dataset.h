// Converts tables of `vegard profile`, `vegard keogram` and a run's profiles.csv to netCDF.
#pragma once

#include <string>
#include <string_view>

#include "fit/report/netcdf/keyed_table.h"
#include "sim/base/file/netcdf_dataset.h"

namespace vegard::fit {

/// Adds a table's variables with its dimensions: for a profile band and row (or azimuth_deg and
/// elevation_deg), for a keogram time and row (or elevation), for a run band, row and channel. `prefix`
/// precedes the names of variables; `suffix` follows the names of variables and dimensions. Throws
/// sim::Error(unreadable_input) for a table of another kind, and as KeyedTable does.
void add_table(const TextTable& table, const std::string& prefix, const std::string& suffix,
               sim::NetcdfDataset& dataset);

/// Converts a whole table, with its comments as attributes. `name` is that of the file, for messages.
sim::NetcdfDataset table_dataset(std::string_view text, const std::string& name);

}  // namespace vegard::fit
