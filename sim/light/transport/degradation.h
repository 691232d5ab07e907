// The energies of electrons after collisions: the cross-sections of sim/light/transport/collisions.h between
// the energies of a grid.
//
// Every collision conserves number and energy on the grid: what is left of the first electron, the second
// one and an Auger electron are each shared out to the two energies about theirs (energy_grid.h), what falls
// below the lowest energy is thermal, and the rest stays in the molecule.
//
// Angles: after a loss W of E an electron goes straight on with the probability sqrt(1 - W/E), the cosine of
// a binary encounter, and anywhere else: its mean cosine is the encounter's. Second electrons go anywhere.
#pragma once

#include <array>
#include <cstddef>
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
  std::array<GasDegradation, kGases> gases;
};

/// Computes the cross-sections on a grid; deterministic. Takes some tenths of a second for a grid up to 20
/// keV.
Degradation degradation(const EnergyGrid& grid);

}  // namespace vegard::sim
