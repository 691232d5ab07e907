#include "fit/measure/bin_grid.h"

#include <algorithm>

namespace vegard::fit {
namespace {

constexpr int kHorizontalBin = 8;  ///< pixels
constexpr int kCellsEachSide = 1;

/// Bands of the bins of another grid, by where their centres lie among the profiles' bins; where there is
/// none, by column.
void take_bands(const BinGrid& profiles, BinGrid& grid) {
  const Region& region = profiles.region;
  const std::vector<int> of_column = bands_of_columns(region, profiles.groups);
  std::vector<int> of_pixel(static_cast<std::size_t>(region.width) * region.height, kNoBin);
  for (std::size_t b = 0; b < profiles.bins(); ++b)
    for (std::size_t r = profiles.first_run[b]; r < profiles.first_run[b + 1]; ++r) {
      const BinGrid::Run& run = profiles.runs[r];
      int* row = of_pixel.data() + static_cast<std::size_t>(run.y - region.y) * region.width - region.x;
      std::fill(row + run.begin, row + run.end, profiles.band[b]);
    }
  grid.band.assign(grid.bins(), 0);
  for (std::size_t b = 0; b < grid.bins(); ++b) {
    if (grid.first_run[b] == grid.first_run[b + 1]) continue;
    const BinGrid::Run &first = grid.runs[grid.first_run[b]], &last = grid.runs[grid.first_run[b + 1] - 1];
    const int x = (first.begin + last.end) / 2 - region.x, y = (first.y + last.y) / 2 - region.y;
    const int band = of_pixel[static_cast<std::size_t>(y) * region.width + x];
    grid.band[b] = band != kNoBin ? band : of_column[x];
  }
}

}  // namespace

std::vector<int> bands_of_columns(const Region& region, int bands) {
  std::vector<int> band(region.width);
  for (int b = 0; b < bands; ++b)
    std::fill(band.begin() + (band_begin(region, bands, b) - region.x),
              band.begin() + (band_begin(region, bands, b + 1) - region.x), b);
  return band;
}

BinGrid horizontal_bins(const BinGrid& profiles, int strips) {
  BinGrid grid;
  grid.region = profiles.region;
  const Region& region = grid.region;
  const int bands = profiles.groups;
  const int each = std::max(1, region.width / bands / kHorizontalBin);
  grid.groups = std::min(strips, region.height);
  grid.positions = bands * each;
  std::vector<int> position(region.width);
  for (int b = 0; b < bands; ++b) {
    const int begin = band_begin(region, bands, b) - region.x,
              end = band_begin(region, bands, b + 1) - region.x;
    for (int x = begin; x < end; ++x) position[x] = b * each + (x - begin) * each / (end - begin);
  }
  grid.position_px = static_cast<double>(region.width) / grid.positions;
  grid.narrowest_px = region.width / grid.positions;
  gather(
      [&](int x, int y) {
        const int strip =
            static_cast<int>(static_cast<long long>(y - region.y) * grid.groups / region.height);
        return strip * grid.positions + position[x - region.x];
      },
      grid);
  take_bands(profiles, grid);
  return grid;
}

BinGrid image_bins(const BinGrid& profiles, int cell_px) {
  BinGrid grid;
  grid.region = profiles.region;
  const Region& region = grid.region;
  const int cell = std::min({cell_px, region.width, region.height});
  grid.groups = region.height / cell;
  grid.positions = region.width / cell;
  grid.pooled = kCellsEachSide;
  grid.position_px = 0.0;
  grid.narrowest_px = cell;
  gather(
      [&](int x, int y) {
        const int across = (x - region.x) / cell, down = (y - region.y) / cell;
        return across < grid.positions && down < grid.groups ? down * grid.positions + across : kNoBin;
      },
      grid);
  take_bands(profiles, grid);
  return grid;
}

}  // namespace vegard::fit
