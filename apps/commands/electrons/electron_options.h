// The options by which `vegard electrons` and `vegard lines --sources` describe the electrons, and the air: a
// built-in one, or the user's table (`--atmosphere`).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/options/command.h"
#include "sim/light/transport/field_air.h"
#include "sim/light/transport/incident_electrons.h"

namespace vegard::apps {

inline constexpr const char* kDefaultAir = "us76";

/// Adds the option. `words` says what a table must have besides its columns.
Option add_air_option(const Command& command, std::string& atmosphere, const std::string& words = {});

/// The file that the air comes from; empty if it is built in (sim/light/air/msis_air.h).
std::string air_file(const std::string& atmosphere);

/// Returns the air. Throws Error(unreadable_input) if the text is neither a name nor a file of that kind.
sim::AirTable air_of_choice(const std::string& atmosphere);

/// "U.S. Standard Atmosphere 1976", a name with its conditions, or the file's name.
std::string words_of_air(const std::string& atmosphere);

struct ElectronOptions {
  std::string spectrum = "maxwellian", pitch = "isotropic", table, atmosphere = kDefaultAir;
  std::optional<double> energy_kev, spread, kappa, potential_kev;
  double flux_mw_m2 = 1.0, dip_deg = 90.0;
};

/// Adds the options, and returns all of them.
std::vector<Option> add_electron_options(const Command& command, ElectronOptions& options);

/// Returns the spectrum. Throws Error(usage) for numbers that do not belong to it, and
/// Error(unreadable_input) for its table.
sim::IncidentSpectrum spectrum_of(const ElectronOptions& options);
sim::PitchAngles pitch_angles_of(const ElectronOptions& options);

/// "maxwellian, 5 keV, 1 mW m^-2, isotropic, dip 90 deg".
std::string electron_words(const ElectronOptions& options, const sim::IncidentSpectrum& spectrum);

/// Throws Error(unreadable_input) about the user's table of the air if the missing share of the electrons'
/// energy is larger than the numerical error of the grids.
void require_balance(const ElectronOptions& options, double missing_share);

}  // namespace vegard::apps
