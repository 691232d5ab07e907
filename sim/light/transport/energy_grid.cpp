#include "sim/light/transport/energy_grid.h"

#include <algorithm>
#include <cmath>

namespace vegard::sim {
namespace {

constexpr double kLowestEv = 0.3;
constexpr double kCoarseEv = 20.0, kFineEv = 1000.0;  // where the spacing begins and ends to change
constexpr double kCoarseStep = 0.05, kFineStep = 0.015;

double relative_step(double energy_ev) {
  const double way = std::log(energy_ev / kCoarseEv) / std::log(kFineEv / kCoarseEv);
  return kCoarseStep + (kFineStep - kCoarseStep) * std::clamp(way, 0.0, 1.0);
}

}  // namespace

double EnergyGrid::width_ev(std::size_t i) const {
  const std::size_t last = size() - 1;
  return 0.5 * (energy_ev[std::min(i + 1, last)] - energy_ev[i == 0 ? 0 : i - 1]);
}

EnergyGrid energy_grid(double highest_ev, double refinement) {
  EnergyGrid grid;
  grid.energy_ev.push_back(kLowestEv);
  while (grid.energy_ev.back() < highest_ev)
    grid.energy_ev.push_back(grid.energy_ev.back() *
                             (1.0 + relative_step(grid.energy_ev.back()) / refinement));
  return grid;
}

EnergyShare share_of_energy(const EnergyGrid& grid, double energy_ev) {
  EnergyShare share;
  if (energy_ev < grid.energy_ev.front()) {
    share.thermal = true;
    return share;
  }
  const auto after = std::upper_bound(grid.energy_ev.begin(), grid.energy_ev.end(), energy_ev);
  if (after == grid.energy_ev.end()) {
    share.lower = grid.size() - 2;
    share.at_upper = 1.0;
    return share;
  }
  share.lower = static_cast<std::size_t>(after - grid.energy_ev.begin()) - 1;
  const double low = grid.energy_ev[share.lower], high = grid.energy_ev[share.lower + 1];
  share.at_upper = (energy_ev - low) / (high - low);
  share.at_lower = 1.0 - share.at_upper;
  return share;
}

}  // namespace vegard::sim
