// The height profile of the light of protons: the Balmer lines of the hydrogen that they become by charge
// exchange, and N2+ beside them.
//
// Heights: all lines follow the ion pairs of Maxwellian protons that come isotropically from above (Fang et
// al. 2013, sim/light/tables/ionisation.h), in the air of the emission tables. Ratios of photons, to Hβ 486.1
// nm:
//
//   427.8 nm  1.6   ESTIMATED to a half: Hβ = 3.0 x N2+ (0,2) 470.9 nm, which is of a theory for protons, and
//                   470.9 nm = 0.21 x 427.8 nm (A-coefficients, Vallance Jones 1974, "Aurora")
//   391.4 nm  3.28 x that of 427.8 nm, as for electrons
//   656.3 nm  4     ESTIMATED to a half
//
// The absolute scale is the brightness that the user gives. No energy flux follows from it: 1 mW m^-2 of
// protons gives some 150 R of Hβ, ESTIMATED to a factor of 2.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"
#include "sim/light/line_profile.h"

namespace vegard::sim {

class EmissionTables;

/// True if protons have light of this line here.
bool is_of_protons(double wavelength_nm);

/// Returns the profile for protons of the characteristic energy E0, with its exact derivative by ln(E0) at
/// the given brightness. `line` must be one of theirs; others are dark.
HeightProfile proton_profile(const EmissionTables& tables, const std::vector<double>& wavelengths_nm,
                             const GivenLine& line, double energy_kev);

}  // namespace vegard::sim
