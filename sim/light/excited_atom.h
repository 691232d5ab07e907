// The path of an excited atom from where an electron struck it to where it shines.
//
// Of the lines that the emission tables hold, three come from metastable atoms: 630.0 nm from O(1D), 557.7 nm
// from O(1S), 520.0 nm from N(2D). Baranoski et al. 2000, section 2.1, give the lifetimes (docs/physics.md
// rows B25 and B26).
//
// **Lifetime.** Collisions can take the energy away (quenching), which shortens the radiative lifetime T to
//
//     tau(h) = 1 / (1/T + sum over gases of k_i n_i(h)).
//
// This is also the mean age of the atoms that radiate: the lifetimes are exponentially distributed with mean
// tau, whether they end by radiation or by quenching. The coefficients k and the lifetime T, which is that of
// all the light of the state, are those of data/electrons/reactions.csv (sim/light/reactions.h), by which the
// program's own emission tables are made. Quenching by electrons and NO is neglected.
//
// **Distance.** With collisions at a frequency nu the velocity along an axis follows Langevin's equation
//
//     dv = -nu v dt + sqrt(2 nu kT/m) dW,    v(0) thermal, of variance kT/m,
//
// so <v(s) v(t)> = kT/m exp(-nu |s - t|), and after a time t the position has the variance
// 2 kT/m (nu t - 1 + exp(-nu t)) / nu^2 (Ornstein and Uhlenbeck 1930, Phys. Rev. 36, 823). The mean over
// exponentially distributed t, with mean(nu t) = nu tau and mean(exp(-nu t)) = 1/(1 + nu tau), is
//
//     sigma^2 = 2 kT/m tau^2 / (1 + nu tau).
//
// Without collisions that is 2 kT/m tau^2, thermal flight (mean t^2 = 2 tau^2); with many, 2 D tau with
// D = kT/(m nu), diffusion. Assumptions: the air is uniform along the path, there is no gravity, and excited
// atoms start with the air's temperature. They are worst above 400 km, where sigma is no longer small
// compared with the scale height of the density, 50 km, and gravity pulls an atom down by tens of kilometres.
// O(1D) from the recombination of O2+ starts hotter and moves farther.
//
// **Collisions.** From D = kT/(m nu) and the binary diffusion coefficient of O in N2 of the U.S. Standard
// Atmosphere 1976 (its table 6, where it is used for all of the air), D n = 6.986e18 (T/273.15 K)^0.75
// cm^-1 s^-1, for N2 and O2; for O the same cross-section with the smaller reduced mass, so a D n that is
// sqrt(10.18/8.00) times larger. The gases combine by Blanc's law, 1/D = sum of 1/D_i. An excited atom is
// assumed to collide like one in the ground state, and N like O.
//
// **The wind** carries an atom by w t: the mean is w tau, and the exponential distribution of t adds (w
// tau)^2 to the variance along the wind. A third of this is added to every axis: the total variance is right,
// its direction is not.
#pragma once

#include <vector>

#include "sim/light/atmosphere.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {

/// True if the line's atoms radiate within a millisecond, so that they move no farther than a metre, or if
/// the line is emitted outside of the air.
bool is_prompt(const EmissionLine& line);

/// Returns tau in seconds. A prompt line is not quenched.
double effective_lifetime_s(const EmissionLine& line, const Air& air);

/// Returns kT/m of the line's atoms, the variance of their velocity along one axis, in m^2 s^-2.
double thermal_variance_m2_s2(const EmissionLine& line, const Air& air);

/// Returns nu, the collision frequency for momentum transfer, in s^-1.
double collision_frequency_s(const EmissionLine& line, const Air& air);

/// Returns sigma^2 along one axis, in the units of `thermal_variance` times s^2.
double displacement_variance(double thermal_variance, double collision_frequency_s, double lifetime_s);

/// Lifetime and displacement of a line's atoms, at the altitudes of a HeightProfile.
struct SpreadProfile {
  std::vector<float> lifetime_s;
  std::vector<float>
      variance_km2;  ///< of the displacement along one axis, with a third of the wind's variance
};

SpreadProfile spread_profile(const EmissionLine& line, double wind_m_s);

}  // namespace vegard::sim
