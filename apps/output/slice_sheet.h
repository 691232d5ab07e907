// A contact sheet of a grid: its maximum projections along the three axes, and slices.
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
  std::optional<std::array<double, 3>> at;  ///< intersection of the three slices; default: the middle
  int along = -1;  ///< if not below 0: instead `count` evenly spaced slices along this axis
  int count = 9;
  double gamma = 1.0;    ///< grey = share of the largest number to the power of 1 / gamma
  double decades = 0.0;  ///< if above 0: grey = 1 + log10(share) / decades, limited
  bool gold = false;
  std::string title, length;  ///< title of the sheet, and its unit of length
};

/// Returns the sheet. `box` must be that of the channel's voxels. Throws Error(usage) for a place outside of
/// it.
fit::Plot slice_sheet(const sim::SparseGrid& grid, const sim::VoxelBox& box, const SheetOptions& options);

}  // namespace vegard::apps
