// Maps of precipitation as input for models of the ionosphere: precipitation files for GEMINI, and
// conductances for Lompe. The layouts and their sources are in docs/file_formats.md.
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

/// Reads maps' directories and resamples the maps to a grid that covers all of them. `time_s`, if given,
/// replaces the time of the map, of which there must be only one. `flux_factor` multiplies all fluxes; 0
/// leaves them unchanged, and refuses fluxes that are only known up to a factor. Throws
/// sim::Error(unreadable_input) if a directory is not a map or has no time, Error(usage) for two maps of the
/// same time, for a negative factor, and as grid_over() does.
ModelInputs model_inputs(const std::vector<std::string>& directories, EarthFrame frame, double step_deg,
                         double flux_factor, std::optional<double> time_s);

/// Variables by time, lat and lon: energy_flux, energy, mean_energy, SP and SH with their standard errors.
sim::NetcdfDataset lompe_dataset(const ModelInputs& inputs);

/// Writes simsize.h5, simgrid.h5, one file per map named by its time, and vegard.json, which describes their
/// source. The HDF5 files are netCDF-4. The directory is written completely or not at all. Throws
/// sim::Error(existing_output, unwritable_output).
void write_gemini(const std::string& directory, bool overwrite, const ModelInputs& inputs);

/// Throws as write_gemini() would, without writing.
void check_gemini_directory(const std::string& directory, bool overwrite);

/// The file name for a time in seconds since 1970: "20140310_21813.500000.h5".
std::string gemini_file_name(double time_s);

}  // namespace vegard::fit
