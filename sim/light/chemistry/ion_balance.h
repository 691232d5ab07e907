// The densities of the ions that electrons produce, and of atoms that live long enough to remember, in
// balance with the air and the thermal electrons, or as they are some time after the electrons have begun to
// fall.
//
// Every ion has its production over its losses (sim/light/reactions.h); the density of thermal
// electrons is that at which it equals the sum of all ions. The sum falls as electrons become more, so there
// is one such density. Above some 250 km O+ lives so long that it moves first: it is taken to leave by
// ambipolar diffusion within H^2/D, H = k(T + Te)/(m g) and D = k(T + Te)/(m nu), nu of O+ in O, N2 and
// O2 (Schunk and Nagy 2009, "Ionospheres", chapter 4), along a vertical field. Where it goes is left out.
#pragma once

#include <limits>
#include <vector>

#include "sim/light/reactions.h"

namespace vegard::sim {

/// The air at a place as chemistry needs it; densities in cm^-3.
struct ReactingAir {
  double altitude_km = 0.0, temperature_k = 0.0, electron_temperature_k = 0.0;
  double n2 = 0.0, o2 = 0.0, o = 0.0, no = 0.0, n = 0.0;
};

/// Production rates of ions, per cm^3 and second.
struct IonProduction {
  double n2p = 0.0, np = 0.0, o2p = 0.0, op = 0.0, op2d = 0.0, op2p = 0.0;
  double all() const { return n2p + np + o2p + op + op2d + op2p; }
};

/// Densities of ions, in cm^-3.
struct IonDensities {
  double n2p = 0.0, np = 0.0, o2p = 0.0, op = 0.0, op2d = 0.0, op2p = 0.0, nop = 0.0;
  double electrons = 0.0;
  double leaving_cm3_s = 0.0;  ///< O+ that diffuses away
  double ions() const { return n2p + np + o2p + op + op2d + op2p + nop; }
};

/// Returns the ions of a night without aurora: electrons of 1e5 cm^-3 at 300 km, half as many 65 km below,
/// and 2e3 farther down. ESTIMATED within a factor of 3, as the auroral zone's F layer varies.
IonDensities night_ions(const ReactingAir& air);

/// The ions since the production has begun.
struct IonHistory {
  std::vector<double> step_s;      ///< from one moment to the next; empty in a steady state
  std::vector<IonDensities> ions;  ///< [moment], from the night's own to the last, or those of the balance
};

/// Returns the ions up to `seconds` after the production has begun, in the night's ions times `night`;
/// without a time, in balance. Eight implicit steps (backward Euler): electrons that grow from nothing are
/// within 8 %.
IonHistory ion_history(const ReactingAir& air, const IonProduction& production, const Reactions& reactions,
                       double seconds = std::numeric_limits<double>::infinity(), double night = 1.0);

/// Returns the ions of the last moment of ion_history().
IonDensities ion_balance(const ReactingAir& air, const IonProduction& production, const Reactions& reactions,
                         double seconds = std::numeric_limits<double>::infinity(), double night = 1.0);

/// Returns the factor on a production with which ions in balance equal this density of electrons. At a given
/// density every ion is proportional to what is produced, so it needs no search.
double balanced_production(const ReactingAir& air, const IonProduction& production,
                           const Reactions& reactions, double electrons_cm3);

/// Returns the densities of atoms that are made and lost at the given rates [moment], none being there
/// before; of a steady state, without steps, what is made over the losses. Between two moments what is made
/// changes linearly, and the losses are the mean of both: exact where both are so.
std::vector<double> atoms_since_onset(const std::vector<double>& step_s,
                                      const std::vector<double>& made_cm3_s,
                                      const std::vector<double>& losses_s);

/// Returns the loss rate of O+ by diffusion, s^-1.
double diffusion_loss_s(const ReactingAir& air);

}  // namespace vegard::sim
