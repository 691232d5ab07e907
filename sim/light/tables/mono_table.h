// The light of mono-energetic electrons. If the emission tables include a table of it (ver_mono.csv), this is
// used; beyond its energies the light is that at its end. Otherwise the light is derived from the tables for
// Maxwellian electrons, so that its integral over a Maxwellian spectrum reproduces these tables.
//
// Then a line's light at an altitude is assumed to be
//
//     v(h; E) = q(h; s(E)) Y(h; E/2)
//
// with q the ion pairs of Fang et al. 2010 (sim/light/tables/ionisation.h) and Y the light per ion pair of
// Maxwellian electrons with the same mean energy, E0 = E/2: the tables' light over the ion pairs that q gives
// for this Maxwellian. Errors that the single energy and the Maxwellian have in common, in the ion pairs per
// energy and in the line's photochemistry, cancel. Two choices are vegard's own; their effects are in
// docs/validation.md, "Mono-energetic electrons":
//
// - s(E) = 0.76 E (E/keV)^0.03. GLOW's two streams lose a fifth of the energy to space and stop higher up:
//   with s = E the ionisation of a Maxwellian peaks 1.2 km (E0 above 5 keV) to 20 km (below 0.5 keV) too low.
//   With the two numbers the shapes of ionisation_electron agree best, on average over the tables' energies.
// - Y is corrected once: the integral of v over a Maxwellian is compared with the tables, and Y is multiplied
//   by the quotient.
//
// Beyond the tables' energies (for data/glow below E = 0.2 keV and above 40 keV) Y is that at their end.
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

/// The logarithm of a rate, and its derivatives by the logarithms of the electrons' energy and of the factor
/// of atomic oxygen.
struct MonoRate {
  double value = 0.0;
  double slope = 0.0;
  double by_log_oxygen = 0.0;
};

class MonoEnergeticTable {
 public:
  /// Uses a table of mono-energetic electrons.
  explicit MonoEnergeticTable(EmissionTable table);

  /// Derives the light for all columns of a table of Maxwellian electrons, in this air, which must have the
  /// table's altitudes. Takes a tenth of a second.
  MonoEnergeticTable(const EmissionTable& maxwellian, const std::vector<StoppingAir>& air);

  const std::vector<double>& altitudes_km() const { return altitudes_km_; }

  /// The energies in keV between which a spectrum may be summed: those of a table that was read, or those of
  /// the pieces that a derived one reproduces Maxwellians with.
  double min_energy_kev() const;
  double max_energy_kev() const;

  bool has(const std::string& column) const;

  /// Returns ln of the rate at altitudes_km(), at Q = 1 mW m^-2, for a column of the tables. A derived rate
  /// is twice differentiable by the energy, but only once where Y becomes constant.
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
  // Of a derived table:
  std::vector<StoppingAir> air_;
  std::vector<double> factors_;
  std::vector<double> log_energies_;  ///< of the mono-energetic electrons, twice the tables' E0
  std::map<std::string, std::vector<Yield>> yields_;  ///< [factor * altitudes + altitude]
};

/// Returns s(E) (see the file's comment): the energy that penetrates as deep by Fang et al. 2010 as E does in
/// GLOW.
double range_energy_kev(double energy_kev);

/// One term of the sum for a Maxwellian, phi(E) = E exp(-E/E0): energies are evenly spaced in ln(E), each
/// with its share of the energy flux.
struct SpectrumPiece {
  double energy_kev = 0.0;
  double share = 0.0;
};
std::vector<SpectrumPiece> maxwellian_pieces(double characteristic_energy_kev);

}  // namespace vegard::sim
