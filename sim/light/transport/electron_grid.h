// The grid of electrons in flight: their energies, and their directions to the field, which elastic
// collisions share out.
#pragma once

#include <cstddef>
#include <vector>

namespace vegard::sim {

/// Energies in eV, increasing. What lies between two of them is shared out to both so that number and energy
/// stay (EnergyShare).
struct EnergyGrid {
  std::vector<double> energy_ev;

  std::size_t size() const { return energy_ev.size(); }
  /// Returns the distance between the middles to the two neighbours; at the ends that to one side alone.
  double width_ev(std::size_t i) const;
};

/// Returns energies from 0.3 eV to at least `highest_ev`, spaced by 5 % of the energy below 20 eV and by 1.5
/// % from 1 keV on, each divided by `refinement`.
EnergyGrid energy_grid(double highest_ev, double refinement = 1.0);

/// An electron of some energy as parts of electrons at two energies of the grid. Below the lowest energy it
/// counts as thermal.
struct EnergyShare {
  std::size_t lower = 0;  ///< the parts are at `lower` and `lower` + 1
  double at_lower = 0.0, at_upper = 0.0;
  bool thermal = false;
};

/// Returns the parts of an electron; at or above the highest energy all of it is at the highest.
EnergyShare share_of_energy(const EnergyGrid& grid, double energy_ev);

/// Cosines of the pitch angle, first those downwards (negative), then those upwards, by Gauss's quadrature in
/// each half, whose weights sum up to 1 there.
struct Streams {
  std::vector<double> cosine, weight;

  std::size_t size() const { return cosine.size(); }
  std::size_t half() const { return cosine.size() / 2; }
};

/// Returns the directions, `half` (4 or 8) in each half.
Streams pitch_streams(int half);

/// The part of elastic collisions that turns electrons into other streams: [to * size + from] for electrons
/// per cosine, times all elastic collisions. The rest of `kept` goes straight on.
struct ElasticTurn {
  std::vector<double> into;
  double kept = 0.0;  ///< 1 - f: the share that counts as collisions
};

/// Screened Rutherford scattering, p(cos) ~ 1/(1 + 2 a - cos)^2, whose screening a gives the mean 1 - cos
/// `transfer_ratio`. Legendre's polynomials below the half's number are kept; the moment of that number is
/// the share f that goes straight on (delta-M: Wiscombe 1977, J. Atmos. Sci. 34, 1408).
ElasticTurn elastic_turn(const Streams& streams, double transfer_ratio);

/// Returns the mean of 1 - cos of that scattering for a screening a.
double mean_turn(double screening);

/// Returns Legendre's moments 0 to `highest` of that scattering.
std::vector<double> scattering_moments(double transfer_ratio, int highest);

}  // namespace vegard::sim
