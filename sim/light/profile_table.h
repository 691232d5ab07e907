// Height profiles of a footprint's electrons, over their energy.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Profiles at evenly spaced logarithms of the energy over footprint.energy_kev. Between two of them the rate
/// is linear in that logarithm, and beyond the ends it is that of the end.
struct ProfileTable {
  double ln_first = 0.0, ln_step = 0.0;  ///< a table of one has no step
  std::vector<HeightProfile> of_energy;
};

/// The light per mW m^-2 of a footprint's electrons, by its key `profile` as a sheet's, for map values of
/// `ln_energy` from ln_least to ln_most. One entry, at ln_first = 0, if both are 0. Each profile carries its
/// d_rate_d_ln_energy, and is dark above top_km. Energies are limited to those of the emission tables.
ProfileTable profile_table(const std::vector<double>& lines_nm, const Scene& scene,
                           const Footprint& footprint, double ln_least, double ln_most);

/// The profiles of a footprint's table with the derivative of the rate by another number in the place of that
/// by ln(energy). Empty where the light does not depend on it.
struct ProfileChanges {
  ProfileTable by_flux;    ///< of the rate per mW m^-2 by the energy flux in mW m^-2, beyond proportion
  ProfileTable by_oxygen;  ///< by the tables' factor of atomic oxygen
};

/// Of `table`, profile_table() of the same footprint.
ProfileChanges profile_changes(const std::vector<double>& lines_nm, const Scene& scene,
                               const Footprint& footprint, const ProfileTable& table);

}  // namespace vegard::sim
