#include "sim/light/transport/electron_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/base/number/gauss_quadrature.h"

namespace vegard::sim {
namespace {

constexpr double kLowestEv = 0.3;
constexpr double kCoarseEv = 20.0, kFineEv = 1000.0;  // where the spacing begins and ends to change
constexpr double kCoarseStep = 0.05, kFineStep = 0.015;

double relative_step(double energy_ev) {
  const double way = std::log(energy_ev / kCoarseEv) / std::log(kFineEv / kCoarseEv);
  return kCoarseStep + (kFineStep - kCoarseStep) * std::clamp(way, 0.0, 1.0);
}

template <int N>
Streams gauss_streams() {
  const GaussLegendre<N> rule;
  Streams result;
  for (const double sign : {-1.0, 1.0})
    for (std::size_t i = 0; i < N; ++i) {
      result.cosine.push_back(sign * rule.place[i]);
      result.weight.push_back(rule.weight[i]);
    }
  return result;
}

/// Returns the screening parameter with this mean of 1 - cos, by bisection in its logarithm.
double screening_of(double transfer_ratio) {
  double low = std::log(1e-9), high = std::log(1e6);
  for (int round = 0; round < 100; ++round) {
    const double middle = 0.5 * (low + high);
    (mean_turn(std::exp(middle)) < transfer_ratio ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

void legendre(double x, int highest, std::vector<double>& values) {
  values.assign(static_cast<std::size_t>(highest) + 1, 1.0);
  if (highest > 0) values[1] = x;
  for (std::size_t l = 1; l + 1 < values.size(); ++l)
    values[l + 1] =
        ((2.0 * static_cast<double>(l) + 1.0) * x * values[l] - static_cast<double>(l) * values[l - 1]) /
        (static_cast<double>(l) + 1.0);
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

double mean_turn(double screening) {
  return 2.0 * screening * ((1.0 + screening) * std::log1p(1.0 / screening) - 1.0);
}

Streams pitch_streams(int half) {
  assert(half == 4 || half == 8);
  return half == 4 ? gauss_streams<4>() : gauss_streams<8>();
}

std::vector<double> scattering_moments(double transfer_ratio, int highest) {
  std::vector<double> moments(static_cast<std::size_t>(highest) + 1, 0.0);
  moments[0] = 1.0;
  if (transfer_ratio >= 1.0 || highest == 0) return moments;
  moments[1] = 1.0 - transfer_ratio;
  const double screening = screening_of(transfer_ratio);
  if (screening > 0.1) {  // smooth, and the recurrence would lose digits
    static const GaussLegendre<48> rule;
    std::vector<double> p, sums(moments.size(), 0.0);
    for (std::size_t i = 0; i < 48; ++i) {
      const double x = 2.0 * rule.place[i] - 1.0, far = 1.0 + 2.0 * screening - x;
      legendre(x, highest, p);
      for (std::size_t l = 0; l < sums.size(); ++l) sums[l] += rule.weight[i] * p[l] / (far * far);
    }
    for (std::size_t l = 2; l < sums.size(); ++l) moments[l] = sums[l] / sums[0];
    return moments;
  }
  // Derivatives of Legendre's functions of the second kind at 1 + 2 a.
  for (std::size_t l = 1; l + 1 < moments.size(); ++l)
    moments[l + 1] = ((2.0 * static_cast<double>(l) + 1.0) * (1.0 + 2.0 * screening) * moments[l] -
                      (static_cast<double>(l) + 1.0) * moments[l - 1]) /
                     static_cast<double>(l);
  return moments;
}

ElasticTurn elastic_turn(const Streams& streams, double transfer_ratio) {
  const auto highest = static_cast<int>(streams.half());
  const std::vector<double> moments = scattering_moments(transfer_ratio, highest);
  const double ahead = moments.back();
  const std::size_t n = streams.size();
  std::vector<std::vector<double>> p(n);
  for (std::size_t k = 0; k < n; ++k) legendre(streams.cosine[k], highest, p[k]);
  ElasticTurn turn;
  turn.kept = 1.0 - ahead;
  turn.into.assign(n * n, 0.0);
  for (std::size_t to = 0; to < n; ++to)
    for (std::size_t from = 0; from < n; ++from)
      for (std::size_t l = 0; l < static_cast<std::size_t>(highest); ++l)
        turn.into[to * n + from] += (static_cast<double>(l) + 0.5) * (moments[l] - ahead) * p[to][l] *
                                    p[from][l] * streams.weight[from];
  return turn;
}

}  // namespace vegard::sim
