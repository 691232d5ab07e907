// One fit as a directory: result.json, best.toml, profiles.csv, trace.csv, map.svg, model.exr,
// residual.exr, report.html, and result.nc if it is asked for. Of several photographs: profiles-NAME.csv,
// model-NAME.exr and residual-NAME.exr for each.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// What the writing needs to know beside the result.
struct RunContext {
  int threads = 0;      ///< for the model's picture; 0: all cores. The files do not depend on it.
  bool netcdf = false;  ///< all numbers in result.nc as well (fit/report/netcdf)
};

/// Throws as write_run would, without writing: to be asked before the long work.
void check_run_directory(const std::string& directory, bool overwrite);

/// Writes all of it; the directory appears whole or not at all. The same result and photographs, in the order
/// of result.photos, give the same bytes; best.toml names several by their way from the directory, which
/// starts at `result.best.file`. Throws sim::Error(existing_output) if there is such a directory and
/// overwrite is false, or something that is no run; sim::Error(unwritable_output) if the disk is full or
/// closed, and nothing is left behind then.
void write_run(const std::string& directory, bool overwrite, const FitResult& result,
               const std::vector<Photo>& photos, const RunContext& context);
void write_run(const std::string& directory, bool overwrite, const FitResult& result, const Photo& photo,
               const RunContext& context);

}  // namespace vegard::fit
