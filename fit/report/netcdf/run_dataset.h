// A run, a map or a sequence as netCDF, from the files in its directory; docs/file_formats.md has the
// variables.
#pragma once

#include <string>
#include <vector>

#include "fit/sequence.h"
#include "sim/base/file/netcdf_dataset.h"

namespace vegard::fit {

/// Names of what `--netcdf` writes into a run's, a map's and a sequence's directory.
inline constexpr const char* kRunNetcdf = "result.nc";
inline constexpr const char* kSequenceNetcdf = "sequence.nc";

/// Of `vegard fit`: result.json and the tables profiles.csv, profiles-NAME.csv and profile.csv. Throws
/// sim::Error(unreadable_input) for what is no run's directory.
sim::NetcdfDataset run_dataset(const std::string& directory);

/// Of the frames of a sequence, in this order.
sim::NetcdfDataset sequence_dataset(const std::vector<SequenceRow>& rows);

/// The rows in frames/*.json of a sequence's directory, by time. Throws sim::Error(unreadable_input).
std::vector<SequenceRow> read_sequence_rows(const std::string& directory);

/// Of whatever `path` is: the directory of a run, a map or a sequence, or a table that table_dataset() reads.
/// Throws sim::Error(unreadable_input).
sim::NetcdfDataset dataset_of(const std::string& path);

}  // namespace vegard::fit
