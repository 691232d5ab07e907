// The directory of a fit: result.json, best.toml, profiles.csv, trace.csv, map.svg, model.exr, residual.exr,
// report.html, and result.nc if requested. With several photographs: profiles-NAME.csv, model-NAME.exr and
// residual-NAME.exr for each.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// What the writer needs in addition to the result.
struct RunContext {
  int threads = 0;      ///< for rendering the model's picture; 0: all cores. The files do not depend on it.
  bool netcdf = false;  ///< whether all numbers are also written to result.nc (fit/report/netcdf)
};

/// Throws as write_run() would, without writing; to be called before the long work.
void check_run_directory(const std::string& directory, bool overwrite);

/// Writes the directory, completely or not at all. The same result and photographs, in the order of
/// result.photos, give the same bytes. If there are several photographs, best.toml names them by relative
/// paths from the directory, computed from `result.best.file`. Throws sim::Error(existing_output) if the
/// directory exists and overwrite is false, or if it is something other than a run;
/// sim::Error(unwritable_output) if the disk is full or not writable, and then leaves nothing behind.
void write_run(const std::string& directory, bool overwrite, const FitResult& result,
               const std::vector<Photo>& photos, const RunContext& context);
void write_run(const std::string& directory, bool overwrite, const FitResult& result, const Photo& photo,
               const RunContext& context);

}  // namespace vegard::fit
