// The energies of a sheet's electrons, by the kind of its profile.
#pragma once

#include <optional>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Mean energy by number: twice energy_kev, which is E0, of Maxwellian electrons (and of a form's, whose
/// lines are theirs); energy_kev of mono-energetic ones; that of the Gaussian. None where the profile does
/// not come from electrons.
std::optional<double> mean_energy_kev(const Sheet& sheet);

}  // namespace vegard::sim
