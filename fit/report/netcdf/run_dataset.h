// Converts a run, a map or a sequence to netCDF, from the files in its directory; the variables are described
// in docs/file_formats.md.
#pragma once

#include <string>
#include <vector>

#include "fit/map/precipitation_planes.h"
#include "fit/sequence.h"
#include "sim/base/file/netcdf_dataset.h"

namespace vegard::fit {

/// Names of the files that `--netcdf` writes into the directory of a run, of a sequence and of a map.
inline constexpr const char* kRunNetcdf = "result.nc";
inline constexpr const char* kSequenceNetcdf = "sequence.nc";
inline constexpr const char* kMapNetcdf = "precipitation.nc";

/// Converts a run of `vegard fit`: result.json and the tables profiles.csv, profiles-NAME.csv and
/// profile.csv. Throws sim::Error(unreadable_input) if the directory is not a run's.
sim::NetcdfDataset run_dataset(const std::string& directory);

/// Converts the frames of a sequence, in this order.
sim::NetcdfDataset sequence_dataset(const std::vector<SequenceRow>& rows);

/// Reads the rows in frames/*.json of a sequence's directory, sorted by time. Throws
/// sim::Error(unreadable_input).
std::vector<SequenceRow> read_sequence_rows(const std::string& directory);

/// Converts a map of precipitation: map.json, precipitation.fits and curtains.csv. Throws
/// sim::Error(unreadable_input) if the directory is not a map's.
sim::NetcdfDataset map_dataset(const std::string& directory);

/// Adds the dimensions north and east, the coordinates of a map's cells, its altitude, site and time.
void add_map_places(const PrecipitationPlanes& map, sim::NetcdfDataset& dataset);

/// Converts whatever `path` is: the directory of a run, a map or a sequence, or a table that table_dataset()
/// reads. Throws sim::Error(unreadable_input).
sim::NetcdfDataset dataset_of(const std::string& path);

}  // namespace vegard::fit
