// The options by which `vegard electrons` and `vegard lines --sources` describe the electrons, and the air.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/options/air_options.h"
#include "apps/options/command.h"
#include "sim/light/transport/incident_electrons.h"

namespace vegard::apps {

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
