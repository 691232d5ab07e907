#include "fit/map/sequence/drift_field.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/random.h"
#include "sim/base/parallel.h"
#include "sim/render/ground/ground_rates.h"

namespace vegard::fit {
namespace {

using sim::kGroundEnergies;

constexpr double kNodeStep_km = 150.0;
constexpr std::size_t kCellsAtOnce = 1024;

}  // namespace

DriftNet DriftNet::over(const sim::GroundGrid& grid) {
  double west = 1e9, east = -1e9, south = 1e9, north = -1e9;
  for (int c = 0; c < grid.cells(); ++c) {
    const sim::EastNorth middle = grid.middle_km(c);
    west = std::min(west, middle.east);
    east = std::max(east, middle.east);
    south = std::min(south, middle.north);
    north = std::max(north, middle.north);
  }
  DriftNet net;
  net.step_km = kNodeStep_km;
  net.columns = std::max(2, static_cast<int>(std::ceil((east - west) / kNodeStep_km)) + 1);
  net.rows = std::max(2, static_cast<int>(std::ceil((north - south) / kNodeStep_km)) + 1);
  net.west_km = 0.5 * (west + east) - 0.5 * kNodeStep_km * (net.columns - 1);
  net.south_km = 0.5 * (south + north) - 0.5 * kNodeStep_km * (net.rows - 1);
  return net;
}

DriftNet::Share DriftNet::share_at(sim::EastNorth place) const {
  const double x = std::clamp((place.east - west_km) / step_km, 0.0, columns - 1.0);
  const double y = std::clamp((place.north - south_km) / step_km, 0.0, rows - 1.0);
  const int column = std::min(static_cast<int>(x), columns - 2),
            row = std::min(static_cast<int>(y), rows - 2);
  const double right = x - column, up = y - row;
  const auto first = static_cast<std::size_t>(row) * columns + column;
  const auto above = first + static_cast<std::size_t>(columns);
  return {{first, first + 1, above, above + 1},
          {(1.0 - right) * (1.0 - up), right * (1.0 - up), (1.0 - right) * up, right * up}};
}

Drift DriftField::at(sim::EastNorth place) const {
  Drift drift;
  if (!moves()) return drift;
  const DriftNet::Share share = net.share_at(place);
  for (int i = 0; i < 4; ++i) {
    const auto node = static_cast<Eigen::Index>(share.node[i]);
    drift.east_km_s += share.weight[i] * velocity_km_s(2 * node);
    drift.north_km_s += share.weight[i] * velocity_km_s(2 * node + 1);
    drift.growth_per_s += share.weight[i] * growth_per_s(node);
  }
  return drift;
}

Eigen::Matrix2d DriftField::covariance_at(sim::EastNorth place) const {
  if (!moves()) return Eigen::Matrix2d::Constant(sim::kNaN);
  const DriftNet::Share share = net.share_at(place);
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      sum += share.weight[i] * share.weight[j] *
             covariance.block<2, 2>(2 * static_cast<Eigen::Index>(share.node[i]),
                                    2 * static_cast<Eigen::Index>(share.node[j]));
  return sum;
}

CellPoints::CellPoints(const sim::GroundGrid& grid) : grid_(grid) {
  constexpr std::uint64_t kSeed = 11;  // of places within cells: any will do
  for (int c = 0; c < grid.cells(); ++c) {
    const sim::EastNorth middle = grid.middle_km(c);
    const double distance = std::max(1e-9, std::hypot(middle.east, middle.north));
    const double out_east = middle.east / distance, out_north = middle.north / distance;
    const double depth = grid.depth_km(c), breadth = grid.breadth_km(c);
    const sim::Words drawn =
        sim::random_words(kSeed, sim::Stream::bootstrap, static_cast<std::uint32_t>(c), 0, 0);
    const double u = sim::fine_uniform(drawn[0], drawn[1]), v = sim::fine_uniform(drawn[2], drawn[3]);
    for (int i = 0; i < kPointsAlong; ++i)
      for (int j = 0; j < kPointsAlong; ++j) {
        const double out = ((i + u) / kPointsAlong - 0.5) * depth,
                     aside = ((j + v) / kPointsAlong - 0.5) * breadth;
        point_km_.push_back({middle.east + out * out_east + aside * out_north,
                             middle.north + out * out_north - aside * out_east});
      }
    half_step_km_.push_back(0.5 * std::min(depth, breadth));
  }
}

CellPoints::Sources CellPoints::after(const DriftField& drift, double seconds, int threads) const {
  return after(drift, seconds, {0.0, 0.0}, threads);
}

CellPoints::Sources CellPoints::after(const DriftField& drift, double seconds, sim::EastNorth shift,
                                      int threads) const {
  const auto cells = static_cast<std::size_t>(grid_.cells());
  Sources sources;
  sources.cell.assign(cells * kPoints, -1);
  sources.factor.assign(cells, 0.0f);
  sim::parallel_for((cells + kCellsAtOnce - 1) / kCellsAtOnce, threads, [&](std::size_t part, int) {
    for (std::size_t c = part * kCellsAtOnce; c < std::min(cells, (part + 1) * kCellsAtOnce); ++c) {
      const Drift here = drift.at(grid_.middle_km(static_cast<int>(c)));
      const double east = shift.east * half_step_km_[c] - here.east_km_s * seconds,
                   north = shift.north * half_step_km_[c] - here.north_km_s * seconds;
      sources.factor[c] = static_cast<float>(std::exp(here.growth_per_s * seconds) / kPoints);
      for (std::size_t p = c * kPoints; p < (c + 1) * kPoints; ++p)
        sources.cell[p] = grid_.cell_at(point_km_[p].east + east, point_km_[p].north + north);
    }
  });
  return sources;
}

std::vector<std::uint8_t> CellPoints::Sources::from_unknown(const std::vector<std::uint8_t>& known) const {
  std::vector<std::uint8_t> unknown(factor.size(), 0);
  for (std::size_t i = 0; i < cell.size(); ++i)
    if (cell[i] < 0 || known[static_cast<std::size_t>(cell[i])] == 0) unknown[i / kPoints] = 1;
  return unknown;
}

std::vector<float> CellPoints::Sources::moved(const std::vector<float>& before, int threads) const {
  const std::size_t cells = factor.size();
  std::vector<std::uint8_t> lit(cells, 0);
  for (std::size_t i = 0; i < before.size(); ++i)
    if (before[i] != 0.0f) lit[i / kGroundEnergies] = 1;
  std::vector<float> after(before.size(), 0.0f);
  sim::parallel_for((cells + kCellsAtOnce - 1) / kCellsAtOnce, threads, [&](std::size_t part, int) {
    for (std::size_t c = part * kCellsAtOnce; c < std::min(cells, (part + 1) * kCellsAtOnce); ++c) {
      float* to = &after[c * kGroundEnergies];
      bool any = false;
      for (std::size_t p = c * kPoints; p < (c + 1) * kPoints; ++p) {
        if (cell[p] < 0 || lit[static_cast<std::size_t>(cell[p])] == 0) continue;
        any = true;
        const float* from = &before[static_cast<std::size_t>(cell[p]) * kGroundEnergies];
        for (int k = 0; k < kGroundEnergies; ++k) to[k] += from[k];
      }
      if (any)
        for (int k = 0; k < kGroundEnergies; ++k) to[k] *= factor[c];
    }
  });
  return after;
}

}  // namespace vegard::fit
