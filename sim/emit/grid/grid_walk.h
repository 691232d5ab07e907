// The path of a ray through bricks: from one to the next, and over empty space in coarse cells of four
// bricks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "sim/emit/grid/grid_bricks.h"

namespace vegard::sim {

/// A ray in voxels: its point at the distance t, in km, is from + t along.
struct GridRay {
  double from[3], along[3];
  double inverse[3];  ///< of `along`

  /// Sets `inverse`. Along an axis on which it is infinite, the ray is taken not to move.
  void aim() {
    for (int a = 0; a < 3; ++a) {
      inverse[a] = 1.0 / along[a];
      if (std::isinf(inverse[a])) along[a] = 0.0;
    }
  }
};

/// The cells of a lattice of pitch `edge` that a ray meets between `begin` and `end`, in their order, after
/// Amanatides and Woo (1987), A fast voxel traversal algorithm for ray tracing, Eurographics '87. Calls
/// use(cell, begin of it, end of it) for those inside [low, high). Each cell begins exactly where the
/// previous one ends.
template <class Use>
inline void walk_cells(const GridRay& ray, double edge, const int low[3], const int high[3], double begin,
                       double end, const Use& use) {
  int cell[3], to[3];  // `to`: how many cells are left along each axis
  double next[3], pitch[3];
  int up[3];
  for (int a = 0; a < 3; ++a) {
    const double at = std::floor((ray.from[a] + begin * ray.along[a]) * (1.0 / edge));
    cell[a] = static_cast<int>(std::clamp(at, static_cast<double>(low[a]), static_cast<double>(high[a] - 1)));
    if (ray.along[a] == 0.0) {
      next[a] = pitch[a] = std::numeric_limits<double>::infinity();
      up[a] = 0;
      to[a] = 0;
      continue;
    }
    up[a] = ray.along[a] > 0.0 ? 1 : -1;
    to[a] = up[a] > 0 ? high[a] - 1 - cell[a] : cell[a] - low[a];
    pitch[a] = edge * std::abs(ray.inverse[a]);
    next[a] = ((cell[a] + (up[a] > 0 ? 1 : 0)) * edge - ray.from[a]) * ray.inverse[a];
  }
  double t = begin;
  while (t < end) {
    const int a = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const double leave = std::min(next[a], end);
    if (leave > t) {
      use(cell, t, leave);
      t = leave;
    }
    if (--to[a] < 0) return;
    cell[a] += up[a];
    next[a] += pitch[a];
  }
}

/// Calls use(brick, its coordinates, begin, end) for the bricks that a ray meets before `end_km`, in order.
/// Does nothing for a ray with numbers that are not finite, or that does not move along any axis.
template <class Use>
void walk_bricks(const GridBricks& grid, const GridRay& ray, double end_km, const Use& use) {
  constexpr int kCoarse = GridBricks::kCoarse;
  constexpr double kBrick = GridBricks::kEdge, kCell = kBrick * kCoarse;
  double begin = 0.0, end = end_km;
  int low[3], high[3];
  for (int a = 0; a < 3; ++a) {
    if (!std::isfinite(ray.from[a]) || !std::isfinite(ray.along[a])) return;
    low[a] = grid.low(a);
    high[a] = grid.high(a);
    const double first = low[a] * kCell - ray.from[a], last = high[a] * kCell - ray.from[a];
    if (ray.along[a] == 0.0) {
      if (first > 0.0 || last < 0.0) return;
      continue;
    }
    const double one = first * ray.inverse[a], other = last * ray.inverse[a];
    begin = std::max(begin, std::min(one, other));
    end = std::min(end, std::max(one, other));
  }
  if (!(begin < end) || !std::isfinite(end)) return;
  walk_cells(ray, kCell, low, high, begin, end, [&](const int cell[3], double in, double out) {
    const std::int32_t* table = grid.coarse(cell[0], cell[1], cell[2]);
    if (table == nullptr) return;
    int first[3], last[3];
    for (int a = 0; a < 3; ++a) {
      first[a] = cell[a] * kCoarse;
      last[a] = first[a] + kCoarse;
    }
    walk_cells(ray, kBrick, first, last, in, out, [&](const int at[3], double enter, double leave) {
      const std::int32_t brick =
          table[((at[0] - first[0]) * kCoarse + at[1] - first[1]) * kCoarse + at[2] - first[2]];
      if (brick >= 0) use(brick, at, enter, leave);
    });
  });
}

/// Returns the number of the first sample not before t. Samples are at the middles of steps that begin at the
/// ray's origin.
inline std::int64_t first_sample(double t, double steps_per_km) {
  constexpr double kMax = 4e18;  // what is farther is no number of a step
  return static_cast<std::int64_t>(std::clamp(std::ceil(t * steps_per_km - 0.5), -kMax, kMax));
}

/// The light that a ray has collected.
struct GridSum {
  double light[8] = {};      ///< of every line: the samples' emission, summed
  double weighted_km = 0.0;  ///< emission of all lines times distance, summed
  double entry_km = 0.0;     ///< where its first brick begins; infinity if there is none
};

/// Samples each ray every `step_km` by trilinear interpolation. The bits do not depend on the instruction
/// set.
void march_grid(const GridBricks& grid, std::size_t rays, const GridRay* ray, const double* end_km,
                double step_km, GridSum* sums);

}  // namespace vegard::sim
