// The light of mono-energetic electrons, so that the Maxwellian made out of it is that of the emission
// tables.
//
// The tables know Maxwellian electrons only. A line's light at an altitude is taken to be
//
//     v(h; E) = q(h; s(E)) Y(h; E/2)
//
// with q the ion pairs of Fang et al. 2010 (sim/light/ionisation.h) and Y the light per ion pair of the
// Maxwellian electrons that have the same mean energy, E0 = E/2: the tables' light over the ion pairs of the
// Maxwellian that is made out of q. What Fang's and GLOW's transport have in common with both, ion pairs per
// energy and the line's photochemistry, cancels. Two things are ours, and were chosen by what they bring
// (docs/validation.md, "Mono-energetic electrons"):
//
// - s(E) = 0.76 E (E/keV)^0.03. GLOW's two streams lose a fifth of the energy to space and stop higher up:
// with
//   s = E the ionisation of a Maxwellian peaks 1.2 km (E0 above 5 keV) to 20 km (below 0.5 keV) too low. The
//   two numbers bring the shapes of ionisation_electron together, on average over the tables' energies.
// - Y is corrected once: the Maxwellian made out of v is compared with the tables, and the quotient
// multiplies Y.
//
// Beyond the tables' energies, below E = 0.2 keV and above 40 keV, Y is that of their end.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/light/ionisation.h"

namespace vegard::sim {

class MonoEnergeticTable {
 public:
  /// For the embedded tables; made at the first call.
  static const MonoEnergeticTable& glow();

  /// ln of the rate at the altitudes of EmissionTable::glow(), at Q = 1 mW m^-2, for one of its columns that
  /// a line or "ionisation_electron" names. Twice differentiable in the energy but where Y is held, once
  /// there.
  std::vector<LogRate> at_energy(const std::string& column, double energy_kev) const;

 private:
  MonoEnergeticTable();
  void add(const std::string& column);

  std::vector<double> log_energies_;  ///< of the mono-energetic electrons, twice the tables' E0
  struct Yield {
    std::vector<double> log_yield, curvature;  ///< by energy, a natural cubic spline in ln(E)
  };
  LogRate log_yield(const Yield& yield, double log_energy) const;
  std::map<std::string, std::vector<Yield>> yields_;  ///< by altitude
};

/// The energy that reaches as deep after Fang et al. 2010 as E does in GLOW: s(E) above.
double range_energy_kev(double energy_kev);

/// The electrons of a Maxwellian, phi(E) = E exp(-E/E0), in pieces: energies evenly spaced in ln(E), and of
/// each the share of the energy flux.
struct SpectrumPiece {
  double energy_kev = 0.0;
  double share = 0.0;
};
std::vector<SpectrumPiece> maxwellian_pieces(double characteristic_energy_kev);

}  // namespace vegard::sim
