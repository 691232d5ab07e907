// A contact sheet of a grid: its largest numbers along the three axes, and slices.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "fit/report/plot/plot.h"
#include "sim/base/grid/grid_planes.h"
#include "sim/base/grid/sparse_grid.h"

namespace vegard::apps {

struct SheetOptions {
  int channel = 0;
  std::optional<std::array<double, 3>>
      at;          ///< where the three slices meet, in the grid's lengths; or its middle
  int along = -1;  ///< if not below 0: `count` slices, evenly along this axis, instead
  int count = 9;
  double gamma = 1.0;    ///< grey = share of the largest number to the power of 1 / gamma
  double decades = 0.0;  ///< if above 0: grey = 1 + log10(share) / decades, limited
  bool gold = false;
  std::string title, length;  ///< of the sheet, and the words for its lengths
};

/// The box must be that of the channel's voxels. Throws Error(usage) for a place outside of it.
fit::Plot slice_sheet(const sim::SparseGrid& grid, const sim::VoxelBox& box, const SheetOptions& options);

}  // namespace vegard::apps
