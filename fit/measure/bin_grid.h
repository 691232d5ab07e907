// A bin grid assigns pixels to the bins in which a photograph and a model are compared.
//
// A grid is drawn once, with the camera and the field of the scene at the fit's start, and stays where it is
// while parameters move: data and model are averaged over the same pixels, whatever the pixels show.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fit/photo/region.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// What the positions or the groups of a grid are, where they are not rows of the picture and strips of its
/// columns: equal steps of a quantity.
struct BinAxis {
  std::string name;  ///< "distance across the loop"; empty: rows, or columns
  std::string unit;  ///< "px"
  double first = 0.0, step = 1.0;
  bool is_given() const { return !name.empty(); }
  double edge(double which) const { return first + which * step; }
};

/// Groups of bins in a line: bands of vertical positions, strips of horizontal ones, rows of a coarse image's
/// cells. A pixel belongs to one bin or to none, by its centre.
struct BinGrid {
  /// Pixels begin to end - 1 of a row of the picture.
  struct Run {
    int y = 0, begin = 0, end = 0;
  };

  Region region;
  int groups = 0, positions = 0;
  std::vector<Run> runs;               ///< bin after bin, from the top and the left
  std::vector<std::size_t> first_run;  ///< [bin], and the end of the last one's
  std::vector<int> band;               ///< [bin]: whose gain it has, the band that its centre lies in
  std::vector<double> row;             ///< [bin]: mean row of its pixels, counted from the region's top
  int pooled = 0;            ///< positions to either side whose pixels give a bin's noise along with its own
  double position_px = 1.0;  ///< from position to position; 0: neighbours are not to be smoothed together
  int narrowest_px = 1;      ///< width of the narrowest bin
  BinAxis along, across;     ///< what positions are, and what groups are

  std::size_t bins() const { return static_cast<std::size_t>(groups) * positions; }
  std::size_t bin(int group, int position) const {
    return static_cast<std::size_t>(group) * positions + position;
  }
};

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

/// Band of every column of a region, counted from its left: as equal as they can be.
std::vector<int> bands_of_columns(const Region& region, int bands);

/// Horizontal profiles in `strips` equal strips of rows (at most one per row). The columns of each band are
/// shared out evenly to bins of about eight pixels. `profiles`: for the bands.
BinGrid horizontal_bins(const BinGrid& profiles, int strips);

/// A coarse image: square cells from the region's upper left corner; what is left over at the right and the
/// bottom belongs to no bin, unless the region is smaller than a cell.
BinGrid image_bins(const BinGrid& profiles, int cell_px);

}  // namespace vegard::fit
