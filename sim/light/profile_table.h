// Height profiles of a footprint's electrons, tabulated over their energy.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"

namespace vegard::sim {

struct Footprint;
struct Scene;

/// Profiles at evenly spaced values of ln(energy / footprint.energy_kev). Between two of them the rate is
/// linear in this logarithm, and beyond the ends it is that of the end.
struct ProfileTable {
  double ln_first = 0.0, ln_step = 0.0;  ///< the step is 0 in a table of one profile
  std::vector<HeightProfile> of_energy;
};

/// Returns the light per mW m^-2 of a footprint's electrons, by the model that its key `profile` names (as
/// for a sheet), for values of the map `ln_energy` from ln_least to ln_most. The table has one entry, at
/// ln_first = 0, if both are 0. Each profile includes d_rate_d_ln_energy and is dark above top_km. Energies
/// are limited to those of the emission tables.
ProfileTable profile_table(const std::vector<double>& lines_nm, const Scene& scene,
                           const Footprint& footprint, double ln_least, double ln_most);

/// Profiles of a footprint's table whose d_rate_d_ln_energy is the derivative by another number instead. A
/// table is empty if the light does not depend on its number.
struct ProfileChanges {
  ProfileTable by_flux;    ///< d(rate per mW m^-2) / d(energy flux in mW m^-2): the non-linear part only
  ProfileTable by_oxygen;  ///< d rate / d(the tables' factor of atomic oxygen)
};

/// Returns these derivatives for `table`, which is the profile_table() of the same footprint.
ProfileChanges profile_changes(const std::vector<double>& lines_nm, const Scene& scene,
                               const Footprint& footprint, const ProfileTable& table);

}  // namespace vegard::sim
