// Pixels into the bins of a grid.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/measure/bin_grid.h"

namespace vegard::fit {

/// Of a pixel that belongs to no bin.
inline constexpr int kNoBin = -1;

/// Puts every pixel of the grid's region into the bin that bin_of(x, y) names, or into none; fills in the
/// runs and the mean rows.
template <class BinOf>
void gather(const BinOf& bin_of, BinGrid& grid) {
  struct Found {
    int bin;
    BinGrid::Run run;
  };
  std::vector<Found> found;
  std::vector<std::size_t> runs_of(grid.bins() + 1, 0);
  const Region& region = grid.region;
  for (int y = region.y; y < region.y + region.height; ++y) {
    int bin = kNoBin;
    for (int x = region.x; x < region.x + region.width; ++x) {
      const int here = bin_of(x, y);
      if (here != bin && here != kNoBin) {
        found.push_back({here, {y, x, x}});
        ++runs_of[here + 1];
      }
      bin = here;
      if (bin != kNoBin) found.back().run.end = x + 1;
    }
  }
  for (std::size_t b = 0; b < grid.bins(); ++b) runs_of[b + 1] += runs_of[b];
  grid.first_run = runs_of;
  grid.runs.resize(found.size());
  for (const Found& f : found) grid.runs[runs_of[f.bin]++] = f.run;

  grid.row.resize(grid.bins());
  for (std::size_t b = 0; b < grid.bins(); ++b) {
    double sum = 0.0, pixels = 0.0;
    for (std::size_t r = grid.first_run[b]; r < grid.first_run[b + 1]; ++r) {
      const double width = grid.runs[r].end - grid.runs[r].begin;
      sum += width * (grid.runs[r].y - region.y);
      pixels += width;
    }
    grid.row[b] = pixels > 0.0 ? sum / pixels : static_cast<double>(b % grid.positions);
  }
}

}  // namespace vegard::fit
