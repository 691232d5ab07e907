// The electrons that a file tells of, with their errors: a map, a run of fit, an answer of invert, a table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/map/precipitation_planes.h"
#include "sim/light/ionosphere/ionosphere_table.h"

namespace vegard::fit {

/// Either a map or rows. All electrons are Maxwellian.
struct ElectronSource {
  std::optional<PrecipitationPlanes> map;
  std::vector<sim::ElectronEstimate> rows;
  std::string row_name;             ///< of what numbers the rows, "UT_h"; empty: one row, or no such column
  std::vector<double> row_numbers;  ///< one for each row; empty as row_name is
  std::string tables;               ///< the emission tables, where the file names them
  double oxygen_factor = 1.0;
  std::string words;  ///< "the map night/map"
};

/// Reads `path`: the directory of a map, or a file in it (precipitation.nc); that of a run of vegard fit; the
/// JSON that vegard invert -o writes; or a table with the columns energy_kev and energy_flux_mw_m2 and, for
/// errors, the ends of their 68 % intervals, as vegard invert --table writes it. Of a run with electrons of
/// several sheets `name` says which. `flux_factor` multiplies the fluxes of a map; 0 leaves them, and refuses
/// fluxes that are known up to a factor alone. Throws sim::Error(unreadable_input), Error(usage) for a name.
ElectronSource read_electron_source(const std::string& path, const std::string& name, double flux_factor);

}  // namespace vegard::fit
