#include "sim/emit/footprint/map/make_footprint.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/number/noise.h"
#include "sim/base/number/smooth_step.h"
#include "sim/base/parallel.h"
#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/emit/footprint/map/ridges.h"

namespace vegard::sim {
namespace {

constexpr double kPushed = 0.4;   // how far places are pushed aside, in the largest waves
constexpr int kLevelPlaces = 96;  // along either side of the box, from which the dark level is taken
// Half way between planes of nodes, where all noise would be weak.
constexpr double kNoisePlane = 0.5;

/// The height of the ridges at a place, in the largest waves.
class Ridges {
 public:
  Ridges(std::uint64_t seed, int index, int octaves, double plane)
      : seed_(seed), index_(index), octaves_(octaves), plane_(plane) {}

  double at(double x, double y) const {
    const double px = x + kPushed * noise(1, x, y), py = y + kPushed * noise(2, x, y);
    return ridges(octaves_, [&](int k, double scale) { return noise(3 + k, px * scale, py * scale); });
  }

 private:
  double noise(int part, double x, double y) const {
    return gradient_noise(seed_, Stream::footprint, static_cast<std::uint64_t>(index_) << 8 | part, x, y,
                          plane_);
  }

  std::uint64_t seed_;
  int index_, octaves_;
  double plane_;
};

}  // namespace

PlaneFootprint<double> noise_plane(const Footprint& f, std::uint64_t seed, int index, double instant_s,
                                   int threads) {
  PlaneFootprint<double> plane = plane_grid<double>(f);
  FootprintGrid<double>& grid = plane.grid;
  if (f.noise_coverage <= 0.0) return plane;
  const double lives = f.noise_lifetime_s > 0.0 ? instant_s / f.noise_lifetime_s : 0.0;
  const Ridges ridges(seed, index, f.noise_octaves, kNoisePlane + lives);
  const auto height_at = [&](double east_km, double north_km) {
    return ridges.at(east_km / f.noise_scale_km, north_km / f.noise_scale_km);
  };
  // The dark level does not depend on the grid, so that a finer one shows the same.
  std::vector<double> heights(static_cast<std::size_t>(kLevelPlaces) * kLevelPlaces);
  parallel_for(kLevelPlaces, threads, [&](std::size_t row, int) {
    for (int column = 0; column < kLevelPlaces; ++column)
      heights[row * kLevelPlaces + column] =
          height_at(((column + 0.5) / kLevelPlaces - 0.5) * f.size_km.east,
                    ((static_cast<double>(row) + 0.5) / kLevelPlaces - 0.5) * f.size_km.north);
  });
  std::sort(heights.begin(), heights.end());
  const double rank = (1.0 - f.noise_coverage) * static_cast<double>(heights.size() - 1);
  const double dark = heights[static_cast<std::size_t>(rank)], brightest = heights.back();
  if (brightest <= dark) return plane;
  grid.flux_mw_m2.assign(grid.cells(), 0.0);
  parallel_for(grid.rows, threads, [&](std::size_t row, int) {
    const double north = (static_cast<double>(row) + 0.5 - 0.5 * grid.rows) * f.cell_km;
    for (int column = 0; column < grid.columns; ++column) {
      const double east = (column + 0.5 - 0.5 * grid.columns) * f.cell_km;
      const auto fade = [](double place, double size) {
        return smooth_step((1.0 - std::abs(place) / (0.5 * size)) / kNoiseFade);
      };
      const double edge = fade(east, f.size_km.east) * fade(north, f.size_km.north);
      if (edge <= 0.0) continue;
      grid.flux_mw_m2[row * grid.columns + column] =
          edge * smooth_step((height_at(east, north) - dark) / (brightest - dark));
    }
  });
  return plane;
}

}  // namespace vegard::sim
