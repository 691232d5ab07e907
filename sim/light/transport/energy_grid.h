// The energies at which electrons in flight are kept.
#pragma once

#include <cstddef>
#include <vector>

namespace vegard::sim {

/// Energies in eV, increasing. What lies between two of them is shared out to both so that number and energy
/// stay (EnergyShare).
struct EnergyGrid {
  std::vector<double> energy_ev;

  std::size_t size() const { return energy_ev.size(); }
  /// Between the middles to the neighbours; at the ends to one side alone.
  double width_ev(std::size_t i) const;
};

/// From 0.3 eV to at least `highest_ev`, spaced by 5 % of the energy below 20 eV and by 1.5 % from 1 keV on,
/// each divided by `refinement`.
EnergyGrid energy_grid(double highest_ev, double refinement = 1.0);

/// An electron of some energy as parts of electrons at two energies of the grid. Below the lowest there are
/// none: it counts as thermal.
struct EnergyShare {
  std::size_t lower = 0;  ///< the parts are at `lower` and `lower` + 1
  double at_lower = 0.0, at_upper = 0.0;
  bool thermal = false;
};

/// At or above the highest energy the whole is at the highest.
EnergyShare share_of_energy(const EnergyGrid& grid, double energy_ev);

}  // namespace vegard::sim
