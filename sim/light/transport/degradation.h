// The energies of electrons after collisions: the cross-sections of sim/light/transport/collisions.h between
// the energies of a grid.
//
// Every collision conserves number and energy on the grid: what is left of the first electron, the second
// one and an Auger electron are each shared out to the two energies about theirs (energy_grid.h), what falls
// below the lowest energy is thermal, and the rest stays in the molecule.
//
// Angles: after a loss W of E an electron goes straight on with the probability sqrt(1 - W/E), the cosine of
// a binary encounter, and anywhere else: its mean cosine is the encounter's. Second electrons go anywhere.
// With a factor f on the mean turn the probability is 1 - f (1 - sqrt(1 - W/E)), 0 at least.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "sim/light/transport/collisions.h"
#include "sim/light/transport/electron_grid.h"

namespace vegard::sim {

/// The cross-sections of one gas in cm^2; energies are in eV. [to][from - to]: from an energy of the grid to
/// the same or a lower one.
struct GasDegradation {
  std::vector<std::vector<float>> straight, anywhere;
  std::vector<double> inelastic;       ///< by energy: all inelastic collisions
  std::vector<double> elastic;         ///< by energy
  std::vector<double> thermal_ev_cm2;  ///< by energy: to electrons below the grid, per path and density
  std::vector<double> bound_ev_cm2;    ///< by energy: to the molecules
  std::vector<std::vector<double>> excitation;  ///< [of collisions][energy]
  std::vector<std::vector<double>> shell;       ///< [of collisions][energy]
};

struct Degradation {
  EnergyGrid grid;
  std::array<GasCollisions, kGases> collisions;
  std::array<GasDegradation, kGases> gases;
  /// As given to degradation(): factors on curves, by process; what is not among them has 1.
  std::map<int, double> factor_of_process;

  double factor(int process) const {
    const auto found = factor_of_process.find(process);
    return found == factor_of_process.end() ? 1.0 : found->second;
  }
};

/// What a factor may be on besides curves of cross_sections.csv and emissions.csv: the mean turn by elastic
/// collisions (the ratio 101 over 100), and the mean turn by inelastic ones.
inline constexpr int kElasticTurn = 101, kInelasticTurn = 102;

/// Computes the cross-sections on a grid; deterministic. Takes some tenths of a second for a grid up to 20
/// keV. `factor_of_process`: factors on curves of cross_sections.csv and emissions.csv, kElasticTurn,
/// kInelasticTurn.
Degradation degradation(const EnergyGrid& grid, const std::map<int, double>& factor_of_process = {});

}  // namespace vegard::sim
