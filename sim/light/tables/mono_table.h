// The light of mono-energetic electrons: a table of its own (ver_mono.csv) where the emission tables have
// one, beyond whose energies the light is that of its end; else made so that the Maxwellian made out of it is
// that of the emission tables.
//
// Of tables that know Maxwellian electrons only, a line's light at an altitude is taken to be
//
//     v(h; E) = q(h; s(E)) Y(h; E/2)
//
// with q the ion pairs of Fang et al. 2010 (sim/light/tables/ionisation.h) and Y the light per ion pair of
// the Maxwellian electrons that have the same mean energy, E0 = E/2: the tables' light over the ion pairs of
// the Maxwellian that is made out of q. What Fang's and GLOW's transport have in common with both, ion pairs
// per energy and the line's photochemistry, cancels. Two things are ours, and were chosen by what they bring
// (docs/validation.md, "Mono-energetic electrons"):
//
// - s(E) = 0.76 E (E/keV)^0.03. GLOW's two streams lose a fifth of the energy to space and stop higher up:
// with
//   s = E the ionisation of a Maxwellian peaks 1.2 km (E0 above 5 keV) to 20 km (below 0.5 keV) too low. The
//   two numbers bring the shapes of ionisation_electron together, on average over the tables' energies.
// - Y is corrected once: the Maxwellian made out of v is compared with the tables, and the quotient
// multiplies Y.
//
// Beyond the tables' energies (of data/glow below E = 0.2 keV and above 40 keV) Y is that of their end.
// Between factors of atomic oxygen ln Y is a natural cubic spline in the logarithm of the factor, as the
// tables' rates are.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/light/tables/emission_table.h"
#include "sim/light/tables/ionisation.h"

namespace vegard::sim {

/// The logarithm of a rate, and how it grows with those of the electrons' energy and of the factor of atomic
/// oxygen.
struct MonoRate {
  double value = 0.0;
  double slope = 0.0;
  double by_log_oxygen = 0.0;
};

class MonoEnergeticTable {
 public:
  /// Of a table of mono-energetic electrons.
  explicit MonoEnergeticTable(EmissionTable table);

  /// Made for all columns of a table of Maxwellian electrons, in this air, which has its altitudes. Takes a
  /// tenth of a second.
  MonoEnergeticTable(const EmissionTable& maxwellian, const std::vector<StoppingAir>& air);

  const std::vector<double>& altitudes_km() const { return altitudes_km_; }
  bool has(const std::string& column) const;

  /// ln of the rate at altitudes_km(), at Q = 1 mW m^-2, for a column of the tables. Of a made one twice
  /// differentiable in the energy but where Y is held, once there.
  std::vector<MonoRate> at_energy(const std::string& column, double energy_kev,
                                  double oxygen_factor = 1.0) const;

 private:
  struct Yield {
    std::vector<double> log_yield, curvature;  ///< by energy, a natural cubic spline in ln(E)
  };
  void add(const std::string& column, const EmissionTable& maxwellian, double factor);
  SplineValue log_yield(const Yield& yield, double log_energy) const;

  std::optional<EmissionTable> table_;
  std::vector<double> altitudes_km_;
  // Of a made one:
  std::vector<StoppingAir> air_;
  std::vector<double> factors_;
  std::vector<double> log_energies_;  ///< of the mono-energetic electrons, twice the tables' E0
  std::map<std::string, std::vector<Yield>> yields_;  ///< [factor * altitudes + altitude]
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
