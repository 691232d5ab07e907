// An electron that falls into the atmosphere: its number of collisions and its mean energy.
//
// Source: Baranoski et al. 2000, section 3.2; docs/physics.md row B12.
#pragma once

#include <optional>

#include "sim/scene/structs/sheet.h"
namespace vegard::sim {

struct Sheet;

/// Returns the number of collisions that stop an electron: 300 at 10 keV (the source's number), and
/// proportional to the energy. That is one per 33 eV, near the 35 eV that an ion pair costs.
double mean_collisions(double energy_kev);

/// Returns the source's threshold d_t for electrons of this energy, 1 / mean_collisions: 1/300 at 10 keV.
double path_step_of(double energy_kev);

// Energies of a sheet's electrons; they depend on the kind of its profile.

/// Returns the mean energy per electron: 2 E0, twice energy_kev, for a Maxwellian spectrum and for auroral
/// forms, whose line ratios are Maxwellian; energy_kev for mono-energetic electrons;
/// gaussian_mean_energy_kev() for a Gaussian. None if the profile does not come from electrons.
std::optional<double> mean_energy_kev(const Sheet& sheet);

}  // namespace vegard::sim
