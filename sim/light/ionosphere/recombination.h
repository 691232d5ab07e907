// How fast thermal electrons are lost to ions, and how their density grows and decays.
//
// With ion pairs q and the effective recombination coefficient alpha, dN/dt = q - alpha N^2 (M. H. Rees,
// "Physics and Chemistry of the Upper Atmosphere", Cambridge 1989, chapter 6). Alpha is that of the ions in
// balance (sim/light/chemistry/ion_balance.h), q/N^2, or of a published law of the altitude alone.
#pragma once

#include "sim/light/ionosphere/ionosphere.h"

namespace vegard::sim {

enum class RecombinationLaw {
  chemistry,  ///< of the ions in balance
  vickrey,    ///< vickrey_recombination_cm3_s()
};

/// The coefficient at a density, in cm^3 s^-1, and d ln(coefficient) / d ln(density).
struct Recombination {
  double coefficient_cm3_s = 0.0, slope = 0.0;
};

/// Returns the coefficient of ions in balance with electrons of this density, above 0.
Recombination balance_recombination(const ReactingAir& air, const IonospherePhysics& physics,
                                    double electrons_cm3);

/// Returns 2.5e-6 exp(-z/51.2 km) cm^3 s^-1 (Vickrey, Vondrak and Matthews 1982, J. Geophys. Res. 87, 5184,
/// doi:10.1029/JA087iA07p05184), for E region altitudes.
double vickrey_recombination_cm3_s(double altitude_km);

/// A density and its derivatives by the logarithms of the ion pairs, of the coefficient and of the density
/// before.
struct DensityWithSlopes {
  double value = 0.0, by_pairs = 0.0, by_recombination = 0.0, by_before = 0.0;
};

/// Densities in cm^-3 after `seconds` of constant ion pairs (above 0, cm^-3 s^-1) and coefficient: at the
/// end, and the mean. With N_s = sqrt(q/alpha), tau = t sqrt(q alpha) and r = N_before/N_s these are N_s (r +
/// tanh tau)/(1 + r tanh tau) and ln(cosh tau + r sinh tau)/(alpha t).
struct GrownDensity {
  DensityWithSlopes end, mean;
};
GrownDensity grown_density(double pairs_cm3_s, double recombination_cm3_s, double before_cm3, double seconds);

}  // namespace vegard::sim
