// Maps of a column-ratio inversion as files.
#pragma once

#include <string>

#include "fit/columns/column_maps.h"
#include "fit/report/columns/inversion_texts.h"

namespace vegard::fit {

/// FITS, a plane each: energy flux, E0, relative error of the flux, error of ln E0, oxygen factor, its
/// logarithm's error, the second energy, chi2, quality. NaN where there is no answer.
std::string encode_column_maps(const ColumnMaps& maps, const InversionFacts& facts, const std::string& name);

/// netCDF-4 by the CF conventions with variables of the same, whole or not at all.
void write_column_maps_netcdf(const ColumnMaps& maps, const InversionFacts& facts, const std::string& path,
                              const std::string& shown_name);

/// How many pixels have which quality, a line each.
std::string column_maps_text(const ColumnMaps& maps);

}  // namespace vegard::fit
