// How well the ionosphere conducts: collisions of ions and electrons with the air, and the conductivities
// across and along the magnetic field.
//
// Source: R. W. Schunk and A. F. Nagy, "Ionospheres", 2nd edition, Cambridge 2009, chapter 4: table 4.4 (ions
// in other gases), table 4.5 (ions in their own gas, by charge exchange), table 4.6 (electrons in gases), and
// the electrons' collisions with ions, 54.5 n/Te^1.5. The formula of O2+ in O2 holds above 800 K; below, the
// attraction of the molecule's induced dipole is the larger of both (their equation 4.88, with the
// polarisability 1.59e-24 cm^3 of table 4.1), and the larger of both is taken. With r = nu/Omega of each kind
// of charge, e/B times
//
//     Pedersen:  sum over ions of n r/(1 + r^2) + n_e r_e/(1 + r_e^2),
//     Hall:      n_e/(1 + r_e^2) - sum over ions of n/(1 + r^2),
//
// and along the field n_e e^2/(m (nu_en + nu_ei)) + sum over ions of n e^2/(m nu) (chapter 5). Ions are as
// warm as the air, which holds without strong electric fields below some 250 km. Across the field electrons
// collide with the air alone: collisions with ions pass no momentum on to it.
#pragma once

#include "sim/light/chemistry/ion_balance.h"

namespace vegard::sim {

/// Frequencies of momentum transfer to the air, s^-1, by kind of charge; `electrons_with_ions` besides.
struct CollisionFrequencies {
  double op = 0.0, o2p = 0.0, nop = 0.0, n2p = 0.0, np = 0.0;
  double electrons = 0.0;
  double electrons_with_ions = 0.0;
};

CollisionFrequencies collision_frequencies(const ReactingAir& air, double electrons_cm3);

/// Factors on the frequencies, for their uncertainty.
struct CollisionFactors {
  double ions = 1.0, electrons = 1.0;
};

/// In S m^-1.
struct Conductivity {
  double pedersen = 0.0, hall = 0.0, parallel = 0.0;
};

/// Returns the conductivity in a field of `field_nt` nanotesla; without charges 0.
Conductivity conductivity(const ReactingAir& air, const IonDensities& ions, double field_nt,
                          const CollisionFactors& factors = {});

/// Returns the angular gyrofrequency, s^-1, of a singly charged ion of this mass in atomic units.
double ion_gyrofrequency_s(double mass_u, double field_nt);

}  // namespace vegard::sim
