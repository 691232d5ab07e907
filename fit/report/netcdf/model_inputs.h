// Maps of precipitation as models of the ionosphere read them: GEMINI's precipitation files, and the
// conductances that Lompe wants. docs/file_formats.md has the layouts and where they are documented.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/map/geographic_map.h"
#include "sim/base/file/netcdf_dataset.h"

namespace vegard::fit {

/// Maps at increasing times on one grid.
struct ModelInputs {
  GeographicGrid grid;
  std::vector<GeographicMap> maps;
  std::vector<double> times_s;  ///< seconds since 1970 in UTC
  std::vector<std::string> names;
};

/// Reads maps' directories and puts them on a grid over all of them. `time_s`: of the only map, in the place
/// of its own. `flux_factor`: times which all fluxes are; 0 leaves them, and refuses fluxes that are only
/// known up to a factor. Throws sim::Error(unreadable_input) for what is no map or says no time, Error(usage)
/// for two maps of one time, for a negative factor, and as grid_over() does.
ModelInputs model_inputs(const std::vector<std::string>& directories, EarthFrame frame, double step_deg,
                         double flux_factor, std::optional<double> time_s);

/// By time, lat and lon: energy_flux, energy, mean_energy, SP and SH with their standard errors.
sim::NetcdfDataset lompe_dataset(const ModelInputs& inputs);

/// simsize.h5, simgrid.h5, a file a map called by its time, and vegard.json, which says what they are of. The
/// HDF5 files are netCDF-4. The directory appears whole or not at all. Throws sim::Error(existing_output,
/// unwritable_output).
void write_gemini(const std::string& directory, bool overwrite, const ModelInputs& inputs);

/// Throws as write_gemini() would, without writing.
void check_gemini_directory(const std::string& directory, bool overwrite);

/// "20140310_21813.500000.h5", of seconds since 1970.
std::string gemini_file_name(double time_s);

}  // namespace vegard::fit
