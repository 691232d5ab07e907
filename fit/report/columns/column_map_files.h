// Maps of a column-ratio inversion as files.
#pragma once

#include <string>

#include "fit/columns/column_maps.h"
#include "fit/report/columns/inversion_texts.h"

namespace vegard::fit {

/// Returns a FITS file with one plane each for energy flux, E0, relative error of the flux, error of ln E0,
/// oxygen factor, error of its logarithm, the second energy, chi2, quality. NaN where there is no answer.
std::string encode_column_maps(const ColumnMaps& maps, const InversionFacts& facts, const std::string& name);

/// Writes netCDF-4 by the CF conventions with the same quantities, completely or not at all.
void write_column_maps_netcdf(const ColumnMaps& maps, const InversionFacts& facts, const std::string& path,
                              const std::string& shown_name);

/// The number of pixels of each quality, one line each.
std::string column_maps_text(const ColumnMaps& maps);

}  // namespace vegard::fit
