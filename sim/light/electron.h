// An electron on its way down: how fast it is and how often it collides.
//
// Source: Baranoski et al. 2000, section 3.2; docs/physics.md row B12.
#pragma once

#include <optional>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Relativistic speed of an electron of this kinetic energy: 58 455 km/s at 10 keV, which the source rounds
/// to 60 000.
double electron_speed_km_s(double energy_kev);

/// Collisions before it is halted: 300 at 10 keV, as the source has it, and in proportion to the energy. That
/// is one per 33 eV, near the 35 eV that an ion pair costs.
double mean_collisions(double energy_kev);

/// The source's threshold d_t for electrons of this energy, 1 / mean_collisions: 1/300 at 10 keV.
double path_step_of(double energy_kev);

/// Deflection points per metre of a path whose steps are uniform between 0 and path_step of it: the mean step
/// is half the largest.
double deflections_per_metre(double path_step, double path_km);

// The energies of a sheet's electrons, by the kind of its profile.

/// Mean energy by number: twice energy_kev, which is E0, of Maxwellian electrons (and of a form's, whose
/// lines are theirs); energy_kev of mono-energetic ones; that of the Gaussian. None where the profile does
/// not come from electrons.
std::optional<double> mean_energy_kev(const Sheet& sheet);

}  // namespace vegard::sim
