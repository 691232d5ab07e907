// How a footprint's height profiles change with the energy flux, beyond proportion.
#pragma once

#include <vector>

#include "sim/light/profile_table.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The profiles of `table`, profile_table() of the same footprint, with the derivative of the rate per mW
/// m^-2 by the energy flux in mW m^-2 where that by ln(energy) is. Empty where the light goes as the flux.
ProfileTable profile_table_by_flux(const std::vector<double>& lines_nm, const Scene& scene,
                                   const Footprint& footprint, const ProfileTable& table);

}  // namespace vegard::sim
