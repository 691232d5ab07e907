// A bin grid assigns pixels to the bins in which a photograph and a model are compared.
//
// A grid is computed once, with the camera and the field of the scene at the fit's start, and does not change
// while the fit varies parameters: data and model are averaged over the same pixels.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fit/photo/region.h"

namespace vegard::fit {

/// The quantity, in equal steps, that the positions or the groups of a grid stand for, if they are not rows
/// and strips of columns of the picture.
struct BinAxis {
  std::string name;  ///< "distance across the loop"; empty: rows, or columns
  std::string unit;  ///< "px"
  double first = 0.0, step = 1.0;
  bool is_given() const { return !name.empty(); }
  double edge(double which) const { return first + which * step; }
};

/// Bins in groups; the bins of a group are numbered by position. For vertical profiles a group is a band, for
/// horizontal ones a strip of rows, for a coarse image a row of its cells. A pixel belongs to one bin or to
/// none, by its centre.
struct BinGrid {
  /// Pixels begin to end - 1 of a row of the picture.
  struct Run {
    int y = 0, begin = 0, end = 0;
  };

  Region region;
  int groups = 0, positions = 0;
  std::vector<Run> runs;               ///< of all bins, bin by bin; each bin's from the top and the left
  std::vector<std::size_t> first_run;  ///< [bin] index of a bin's first run; a last element ends the last bin
  std::vector<int> band;               ///< [bin] the band in which its centre lies, whose gain it has
  std::vector<double> row;             ///< [bin] mean row of its pixels, counted from the region's top
  int pooled = 0;            ///< positions to either side whose pixels are added to estimate a bin's noise
  double position_px = 1.0;  ///< distance between neighbouring positions; 0: they must not be smoothed
  int narrowest_px = 1;      ///< width of the narrowest bin
  BinAxis along, across;     ///< the quantities of the positions and of the groups

  std::size_t bins() const { return static_cast<std::size_t>(groups) * positions; }
  std::size_t bin(int group, int position) const {
    return static_cast<std::size_t>(group) * positions + position;
  }
};

/// The bin number of a pixel that belongs to no bin.
inline constexpr int kNoBin = -1;

/// Assigns every pixel of the grid's region to the bin bin_of(x, y), which may be kNoBin; fills in the runs
/// and the mean rows.
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

/// Returns the band of every column of a region, counted from its left; the bands' widths differ by at most
/// one pixel.
std::vector<int> bands_of_columns(const Region& region, int bands);

/// Returns the bins of horizontal profiles in `strips` equal strips of rows (at most one per row). The
/// columns of each band are divided evenly into bins of about eight pixels. `profiles`: the grid that gives
/// the bands.
BinGrid horizontal_bins(const BinGrid& profiles, int strips);

/// Returns the bins of a coarse image: square cells from the region's upper left corner. Pixels that fill no
/// whole cell at the right and the bottom belong to no bin, unless the region is smaller than a cell.
BinGrid image_bins(const BinGrid& profiles, int cell_px);

}  // namespace vegard::fit
