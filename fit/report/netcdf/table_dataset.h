// Tables of `vegard profile`, `vegard keogram` and a run's profiles.csv as netCDF.
#pragma once

#include <string>
#include <string_view>

#include "fit/report/netcdf/keyed_table.h"
#include "sim/base/file/netcdf_dataset.h"

namespace vegard::fit {

/// Adds a table's variables by its dimensions: a profile's by band and row (or azimuth_deg and
/// elevation_deg), a keogram's by time and row (or elevation), a run's by band, row and channel. `prefix`
/// stands before the names of variables, `suffix` behind them and those of dimensions. Throws
/// sim::Error(unreadable_input) for a table of another kind, and as KeyedTable does.
void add_table(const TextTable& table, const std::string& prefix, const std::string& suffix,
               sim::NetcdfDataset& dataset);

/// All of a table, its comments as attributes. `name`: of the file, for messages.
sim::NetcdfDataset table_dataset(std::string_view text, const std::string& name);

}  // namespace vegard::fit
