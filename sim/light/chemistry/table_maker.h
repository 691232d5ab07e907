// Makes emission tables: the light of Maxwellian and mono-energetic electrons by altitude and energy,
// for an air and a set of reactions, in the form of a folder of tables (docs/file_formats.md, "Emission
// tables").
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sim/light/reactions.h"
#include "sim/light/transport/degradation.h"
#include "sim/light/transport/field_air.h"
#include "sim/light/transport/incident_electrons.h"

namespace vegard::sim {

/// Return E0 of Maxwellian electrons, 0.1 to 20 keV, and E of mono-energetic ones, 0.05 to 100 keV, of the
/// program's own tables; in keV, as they are written.
std::vector<double> usual_maxwellian_kev();
std::vector<double> usual_mono_kev();

/// The time since the electrons have begun to fall that the program's own tables have. With its uncertainty,
/// a factor of 3, it reaches from the minute of a narrow arc to the nine minutes of quiet precipitation.
inline constexpr double kUsualSeconds = 180.0;

struct TableRequest {
  AirTable air = standard_air_table();
  std::string air_name = "U.S. Standard Atmosphere 1976";
  std::string air_file;  ///< for messages
  double dip_deg = 78.0;
  Reactions reactions = Reactions::standard();
  std::string reactions_name = "data/electrons/reactions.csv";
  double seconds = kUsualSeconds;  ///< since the electrons have begun to fall; infinite: a steady state
  int draws = 0;  ///< of the modes that are written beside the tables, and their seed, for about.json
  std::uint64_t seed = 0;
  std::vector<double> oxygen_factors = {0.5, 1.0, 2.0};  ///< increasing, 1 among them
  std::vector<double> maxwellian_kev = usual_maxwellian_kev(), mono_kev = usual_mono_kev();  ///< increasing
  /// Of the energies and places. At 0.5 columns are within 0.3 % of those at 1, and peaks within 0.1 km.
  double refinement = 0.5;
};

/// What electrons shine, as a table has it: photons or ion pairs cm^-3 s^-1 and mW m^-2 at
/// made_altitudes_km().
struct MadeLight {
  std::vector<std::string> names;          ///< of the columns
  std::vector<std::vector<double>> rates;  ///< [column][altitude]
  std::vector<double> rayleigh;            ///< [column], of the lines, which stand before the ion pairs
};

/// Electrons that come down isotropically.
struct MadeCase {
  SpectrumKind kind = SpectrumKind::maxwellian;
  double oxygen = 1.0, energy_kev = 1.0, flux_mw_m2 = 1.0;
};

/// Returns the light of such electrons in the request's air and by its reactions. Throws as make_tables().
MadeLight made_light(const MadeCase& which, const TableRequest& request, const Degradation& degradation);

/// Returns the electrons' cross-sections, times factors, on a grid that reaches the energies of the request.
Degradation table_degradation(const TableRequest& request,
                              const std::map<int, double>& factor_of_process = {});

/// Throws Error(unreadable_input) if the request's air does not reach from 80 to 640 km.
void require_air_of_tables(const TableRequest& request);

/// Returns a number as printf() writes it, 31 characters at most.
std::string table_number(const char* format, double value);

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
