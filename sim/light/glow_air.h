// The air for which the emission tables were made, as it stops electrons.
//
// Source: data/glow/atmosphere.csv (NRLMSISE-00 through GLOW, see data/README.md). It is not the U.S.
// Standard Atmosphere of sim/light/atmosphere.h, which has the excited atoms' collisions.
#pragma once

#include <vector>

#include "sim/light/ionisation.h"

namespace vegard::sim {

/// At the altitudes of the emission tables, from the bottom up. The mean mass is that of N2, O2 and O;
/// gravity falls with the square of the distance from the Earth's centre.
const std::vector<StoppingAir>& glow_air();

}  // namespace vegard::sim
