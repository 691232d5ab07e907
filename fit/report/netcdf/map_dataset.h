// A map of precipitation as netCDF, from map.json, precipitation.fits and curtains.csv in its directory.
#pragma once

#include <string>

#include "sim/base/file/netcdf_dataset.h"

namespace vegard::fit {

/// Name of what `vegard map --netcdf` writes into a map's directory.
inline constexpr const char* kMapNetcdf = "precipitation.nc";

/// Throws sim::Error(unreadable_input) for what is no map's directory.
sim::NetcdfDataset map_dataset(const std::string& directory);

}  // namespace vegard::fit
