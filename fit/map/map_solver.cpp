#include "fit/map/map_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vegard::fit {
namespace {

using sim::kGroundEnergies;

struct Near {
  int cell;
  float weight;
};

/// Weights of a cell's neighbours, which sum to 1.
std::vector<std::vector<Near>> neighbourhoods(const sim::GroundGrid& grid, double along_km) {
  std::vector<std::vector<Near>> all(static_cast<std::size_t>(grid.cells()));
  for (int cell = 0; cell < grid.cells(); ++cell) {
    const double reach = std::max(along_km, 1.01 * std::max(grid.depth_km(cell), grid.breadth_km(cell)));
    double sum = 0.0;
    for (const auto& near : grid.near(cell, 1.5 * reach)) {
      const double d = std::hypot(near.east_km, near.north_km) / reach;
      const double w = std::exp(-0.5 * d * d * 4.0) * grid.area_km2(near.cell);
      all[cell].push_back({near.cell, static_cast<float>(w)});
      sum += w;
    }
    for (Near& near : all[cell]) near.weight = static_cast<float>(near.weight / sum);
  }
  return all;
}

constexpr double kEpsilon = 1e-3;  // of the brightest neighbourhood: less light counts as none
constexpr double kLevel = 5e-4;    // relative fall from revision to revision that is no longer waited for

/// Gains that are not known, by least squares with the skies solved for: those of R and B beside G where the
/// white balance is unknown, and of every photograph but the first, whose scale is the map's.
void solve_gains(std::vector<MapPicture>& pictures, std::vector<MapLight>& light) {
  for (std::size_t p = 0; p < pictures.size(); ++p) {
    MapPicture& picture = pictures[p];
    const bool balanced = picture.scene().fit.white_balance_known;
    if (p == 0 && balanced) continue;
    MapLight weighted;
    picture.take_sky_away(light[p], weighted);
    std::array<double, 3> by{}, square{};
    for (std::size_t i = 0; i < weighted.size(); ++i) {
      by[i % 3] += static_cast<double>(weighted[i]) * picture.data()[i];
      square[i % 3] += static_cast<double>(weighted[i]) * light[p][i];
    }
    if (balanced) {
      by.fill(by[0] + by[1] + by[2]);
      square.fill(square[0] + square[1] + square[2]);
    }
    for (int c = 0; c < 3; ++c) {
      if (p == 0 && c == picture.reference_channel()) continue;
      if (!(square[c] > 0.0) || !(by[c] > 0.0)) continue;
      const double change = std::clamp(by[c] / square[c], 0.2, 5.0);
      picture.gain[c] *= change;
      for (std::size_t i = c; i < light[p].size(); i += 3) light[p][i] *= static_cast<float>(change);
    }
  }
}

double dot(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * b[i];
  return sum;
}

}  // namespace

MapSolution solve_map(std::vector<MapPicture>& pictures, const sim::GroundGrid& grid, int energies,
                      std::vector<float> start, const MapSolverOptions& options) {
  const auto cells = static_cast<std::size_t>(grid.cells());
  const std::size_t n = cells * kGroundEnergies;
  const auto near = neighbourhoods(grid, options.along_km);
  MapSolution s;
  s.map = std::move(start);
  std::vector<float>& x = s.map;
  std::vector<MapLight> light(pictures.size()), residual(pictures.size()), along(pictures.size());
  for (std::size_t p = 0; p < pictures.size(); ++p) pictures[p].forward(x, light[p]);

  std::vector<float> gradient(n), before, x_before, scale(n, 0.0f), step(n), linear(cells, 0.0f);
  std::vector<float> bond(n, 0.0f), target(n, 0.0f);  // of the spectra
  std::vector<float> flux(cells), smooth(cells);
  double length = 1.0, last = std::numeric_limits<double>::infinity();
  const auto revise = [&] {
    for (std::size_t c = 0; c < cells; ++c) {
      double sum = 0.0;
      for (int k = 0; k < energies; ++k) sum += x[c * kGroundEnergies + k];
      flux[c] = static_cast<float>(sum);
    }
    double most = 0.0;
    for (std::size_t c = 0; c < cells; ++c) {
      double sum = 0.0;
      for (const Near& m : near[c]) sum += m.weight * flux[m.cell];
      smooth[c] = static_cast<float>(sum);
      most = std::max(most, sum);
    }
    const double epsilon = kEpsilon * most;
    for (std::size_t c = 0; c < cells; ++c) {
      linear[c] = static_cast<float>(options.sparsity / (smooth[c] + epsilon));
      if (!options.cell_factor.empty()) linear[c] *= options.cell_factor[c];
      if (options.energy_bond > 0.0) {
        double of[kGroundEnergies] = {};
        for (const Near& m : near[c])
          for (int k = 0; k < energies; ++k) of[k] += m.weight * x[m.cell * kGroundEnergies + k];
        for (int k = 0; k < energies; ++k) {
          target[c * kGroundEnergies + k] = static_cast<float>(flux[c] * of[k] / (smooth[c] + 1e-30));
          bond[c * kGroundEnergies + k] =
              static_cast<float>(options.energy_bond / std::pow(smooth[c] + epsilon, 2));
        }
      }
    }
    // The multiplicative method's scale, x over the positive part of the gradient.
    std::vector<float> positive(n, 0.0f);
    MapLight weighted;
    for (std::size_t p = 0; p < pictures.size(); ++p) {
      const MapLight& w = pictures[p].weight();
      weighted.assign(w.size(), 0.0f);
      for (std::size_t i = 0; i < w.size(); ++i) weighted[i] = w[i] * std::abs(light[p][i]);
      pictures[p].add_adjoint(weighted, positive);
    }
    double mean = 0.0;
    for (const float v : positive) mean += std::max(0.0f, v) / n;
    for (std::size_t i = 0; i < n; ++i)
      scale[i] = 1.0f / (std::max(positive[i], static_cast<float>(1e-3 * mean)) +
                         linear[i / kGroundEnergies] + bond[i] * x[i]);
  };
  // chi2 / 2 with the logarithms that the weights stand for: what all steps together bring down.
  const auto whole = [&](double chi2) {
    double sum = 0.5 * chi2, most = 0.0;
    for (const float q : smooth) most = std::max(most, static_cast<double>(q));
    for (const float q : smooth) sum += options.sparsity * std::log1p(q / (kEpsilon * most));
    return sum;
  };
  for (int it = 0; it < options.steps; ++it) {
    const bool revised = it % options.held == 0;
    if (revised) {
      if (it >= options.gains_from) solve_gains(pictures, light);
      revise();
    }
    double chi2 = 0.0;
    std::fill(gradient.begin(), gradient.end(), 0.0f);
    for (std::size_t p = 0; p < pictures.size(); ++p) {
      chi2 += pictures[p].residual(light[p], residual[p]);
      pictures[p].add_adjoint(residual[p], gradient);
    }
    s.chi2 = chi2;
    s.steps = it;
    if (revised && it > 2 * options.held) {
      const double now = whole(chi2);
      if (last - now < kLevel * now) break;
      last = now;
    }
    if (options.progress) options.progress(it, chi2);
    if (options.stop != nullptr && *options.stop) break;
    for (std::size_t i = 0; i < n; ++i)
      gradient[i] += linear[i / kGroundEnergies] + bond[i] * (x[i] - target[i]);
    // Barzilai's and Borwein's lengths in the scaled metric.
    if (revised || before.empty()) {
      length = 1.0;
    } else {
      double sds = 0.0, sy = 0.0, yy = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        const double sx = static_cast<double>(x[i]) - x_before[i],
                     y = static_cast<double>(gradient[i]) - before[i];
        const double d = std::max(1e-30, static_cast<double>(x[i]) * scale[i]);
        sds += sx * sx / d;
        sy += sx * y;
        yy += y * y * d;
      }
      if (sy > 0.0) {
        const double longer = sds / sy, shorter = sy / yy;
        length = std::clamp(it % 3 == 0 ? longer : shorter, 1e-2, 1e3);
      }
    }
    double slope = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double d = static_cast<double>(x[i]) * scale[i];
      const double to = std::max(0.0, x[i] - length * d * gradient[i]);
      step[i] = static_cast<float>(to - x[i]);
      slope += static_cast<double>(step[i]) * gradient[i];
    }
    if (!(slope < 0.0)) {
      if (revised) break;
      before.clear();
      length = 1.0;
      continue;
    }
    double curvature = 0.0;
    MapLight weighted;
    for (std::size_t p = 0; p < pictures.size(); ++p) {
      pictures[p].forward(step, along[p]);
      pictures[p].take_sky_away(along[p], weighted);
      curvature += dot(along[p], weighted);
    }
    for (std::size_t i = 0; i < n; ++i) curvature += static_cast<double>(bond[i]) * step[i] * step[i];
    const double share = curvature > 0.0 ? std::min(1.0, -slope / curvature) : 1.0;
    before = gradient;
    x_before = x;
    const auto t = static_cast<float>(share);
    for (std::size_t i = 0; i < n; ++i) x[i] = std::max(0.0f, x[i] + t * step[i]);
    for (std::size_t p = 0; p < pictures.size(); ++p)
      for (std::size_t i = 0; i < light[p].size(); ++i) light[p][i] += t * along[p][i];
  }
  return s;
}

}  // namespace vegard::fit
