// Converts a map of precipitation to netCDF, from map.json, precipitation.fits and curtains.csv in its
// directory.
#pragma once

#include <string>

#include "sim/base/file/netcdf_dataset.h"

namespace vegard::fit {

/// Name of the file that `vegard map --netcdf` writes into a map's directory.
inline constexpr const char* kMapNetcdf = "precipitation.nc";

/// Throws sim::Error(unreadable_input) if the directory is not a map's.
sim::NetcdfDataset map_dataset(const std::string& directory);

}  // namespace vegard::fit
