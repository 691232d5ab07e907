// Exports a survey's database as one netCDF-4 file by the CF conventions, version 1.8
// (https://cfconventions.org).
#pragma once

#include <string>

#include "fit/survey/sqlite_file.h"

namespace vegard::fit {

/// Writes the file, completely or not at all; docs/file_formats.md describes its variables. Reads the
/// database twice, some thousand frames at a time. The same rows give the same bytes with the same versions
/// of netCDF and HDF5. Throws as SurveyReader, sim::WholeFile and sim::NetcdfFile do.
void write_survey_netcdf(const SqliteFile& database, const std::string& output, bool overwrite);

}  // namespace vegard::fit
