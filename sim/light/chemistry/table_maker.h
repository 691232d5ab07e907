// Makes emission tables: the light of Maxwellian and mono-energetic electrons by altitude and energy,
// for an air and a set of reactions, in the form of a folder of tables (docs/file_formats.md, "Emission
// tables").
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sim/light/reactions.h"
#include "sim/light/transport/field_air.h"

namespace vegard::sim {

/// Return E0 of Maxwellian electrons, 0.1 to 20 keV, and E of mono-energetic ones, 0.05 to 100 keV, of the
/// program's own tables; in keV, as they are written.
std::vector<double> usual_maxwellian_kev();
std::vector<double> usual_mono_kev();

struct TableRequest {
  AirTable air = standard_air_table();
  std::string air_name = "U.S. Standard Atmosphere 1976";
  std::string air_file;  ///< for messages
  double dip_deg = 78.0;
  Reactions reactions = Reactions::standard();
  std::string reactions_name = "data/electrons/reactions.csv";
  std::vector<double> oxygen_factors = {0.5, 1.0, 2.0};  ///< increasing, 1 among them
  std::vector<double> maxwellian_kev = usual_maxwellian_kev(), mono_kev = usual_mono_kev();  ///< increasing
  /// Of the energies and places. At 0.5 columns are within 0.3 % of those at 1, and peaks within 0.1 km.
  double refinement = 0.5;
};

/// The text of each file of the folder by its name.
using MadeTables = std::map<std::string, std::string>;

/// Returns the altitudes of the tables, 80 to 640 km.
std::vector<double> made_altitudes_km();

/// Makes the tables by some hundreds of transports, in a minute or two on two cores. `progress` is called
/// from any thread with the numbers of finished and of all transports. The bytes do not depend on the number
/// of threads. Throws Error(unreadable_input) if the air does not reach from 80 to 640 km, or the energy does
/// not balance in it.
MadeTables make_tables(const TableRequest& request, int threads,
                       const std::function<void(std::size_t done, std::size_t all)>& progress = {});

}  // namespace vegard::sim
