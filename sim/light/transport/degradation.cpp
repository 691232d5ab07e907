#include "sim/light/transport/degradation.h"

#include <algorithm>
#include <cmath>

namespace vegard::sim {
namespace {

/// Collects the rows of a gas, for collisions of electrons of one energy.
class Collector {
 public:
  Collector(const EnergyGrid& grid, std::size_t from, GasDegradation& gas)
      : grid_(grid), from_(from), gas_(gas) {}

  /// Adds an electron of `energy_ev` after a collision, per path and density `cm2` of them.
  void electron(double energy_ev, double cm2, double straight) {
    const EnergyShare share = share_of_energy(grid_, energy_ev);
    if (share.thermal) {
      gas_.thermal_ev_cm2[from_] += cm2 * energy_ev;
      return;
    }
    add(share.lower, cm2 * share.at_lower, straight);
    add(share.lower + 1, cm2 * share.at_upper, straight);
  }

 private:
  void add(std::size_t to, double cm2, double straight) {
    if (cm2 == 0.0) return;
    if (straight > 0.0) gas_.straight[to][from_ - to] += static_cast<float>(cm2 * straight);
    gas_.anywhere[to][from_ - to] += static_cast<float>(cm2 * (1.0 - straight));
  }

  const EnergyGrid& grid_;
  std::size_t from_;
  GasDegradation& gas_;
};

/// `turn`: factor on the mean turn.
double straight_on(double loss_ev, double energy_ev, double turn) {
  const double cosine = std::sqrt(std::max(0.0, 1.0 - loss_ev / energy_ev));
  return turn == 1.0 ? cosine : std::max(0.0, 1.0 - turn * (1.0 - cosine));
}

void add_excitations(const GasCollisions& collisions, const EnergyGrid& grid, std::size_t from, double turn,
                     GasDegradation& gas) {
  const double energy = grid.energy_ev[from];
  Collector collector(grid, from, gas);
  for (std::size_t e = 0; e < collisions.excitations.size(); ++e) {
    const CollisionCurve& curve = collisions.excitations[e].curve;
    const double cm2 = curve.at(energy);
    gas.excitation[e][from] = cm2;
    if (cm2 <= 0.0) continue;
    gas.inelastic[from] += cm2;
    gas.bound_ev_cm2[from] += cm2 * curve.loss_ev;
    collector.electron(energy - curve.loss_ev, cm2, straight_on(curve.loss_ev, energy, turn));
  }
}

void add_shell(const IonisedShell& shell, double factor, const EnergyGrid& grid, std::size_t from,
               double turn, GasDegradation& gas, std::vector<double>& rates) {
  const double energy = grid.energy_ev[from];
  const ShellSpectrum spectrum(shell, energy);
  const double all = factor * spectrum.cm2();
  if (all <= 0.0) return;
  rates[from] = all;
  gas.inelastic[from] += all;
  gas.bound_ev_cm2[from] += all * (shell.loss_ev - shell.auger_ev);
  Collector collector(grid, from, gas);
  if (shell.auger_ev > 0.0) collector.electron(shell.auger_ev, all, 0.0);
  // Second electrons between the energies of the grid, all of them at the middle.
  double lower = 0.0, below = 0.0;
  for (std::size_t i = 0; lower < spectrum.max_ev(); ++i) {
    const double upper = std::min(i < grid.size() ? grid.energy_ev[i] : spectrum.max_ev(), spectrum.max_ev());
    const double to_here = factor * spectrum.cm2_below(upper);
    const double second = 0.5 * (lower + upper), loss = shell.loss_ev + second;
    collector.electron(second, to_here - below, 0.0);
    collector.electron(energy - loss, to_here - below, straight_on(loss, energy, turn));
    lower = upper;
    below = to_here;
  }
}

GasDegradation degradation_of(const GasCollisions& collisions, const EnergyGrid& grid, double turn) {
  const std::size_t n = grid.size();
  GasDegradation gas;
  for (std::size_t to = 0; to < n; ++to) {
    gas.straight.emplace_back(n - to, 0.0f);
    gas.anywhere.emplace_back(n - to, 0.0f);
  }
  gas.inelastic.assign(n, 0.0);
  gas.elastic.assign(n, 0.0);
  gas.thermal_ev_cm2.assign(n, 0.0);
  gas.bound_ev_cm2.assign(n, 0.0);
  gas.excitation.assign(collisions.excitations.size(), std::vector<double>(n, 0.0));
  gas.shell.assign(collisions.shells.size(), std::vector<double>(n, 0.0));
  for (std::size_t from = 0; from < n; ++from) {
    const double energy = grid.energy_ev[from];
    gas.elastic[from] = collisions.elastic_cm2(energy);
    add_excitations(collisions, grid, from, turn, gas);
    const double factor = collisions.shell_factor(energy);
    for (std::size_t s = 0; s < collisions.shells.size(); ++s)
      add_shell(collisions.shells[s], factor, grid, from, turn, gas, gas.shell[s]);
  }
  return gas;
}

}  // namespace

Degradation degradation(const EnergyGrid& grid, const std::map<int, double>& factor_of_process) {
  Degradation all;
  all.grid = grid;
  all.factor_of_process = factor_of_process;
  all.collisions = scaled_collisions(factor_of_process);
  const double turn = all.factor(kInelasticTurn);
  for (std::size_t g = 0; g < all.gases.size(); ++g)
    all.gases[g] = degradation_of(all.collisions[g], grid, turn);
  return all;
}

}  // namespace vegard::sim
