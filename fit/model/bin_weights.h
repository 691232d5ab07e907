// Which part of a film falls into which bin of a profile, and with what weight.
//
// A bin is any set of film cells: a row of a band, a strip along the elevation or along the field, a cell of
// a coarse picture. Nothing here or in what works with it takes a bin for a row.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "fit/measure/bin_grid.h"
#include "fit/photo/photo.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {

/// Sparse weights [bin][cell][channel]. The value of a bin in a channel is the sum over its cells of
/// pixels * light, times `inverse`: the mean over the bin's usable pixels.
struct BinWeights {
  /// Neighbouring cells of one film row, a part of a bin.
  struct Run {
    int row = 0, first_column = 0, columns = 0;
    std::size_t first_pixels = 0;  ///< of the run's first cell, an index into `pixels`; 3 per cell
  };
  std::vector<Run> runs;               ///< bin after bin
  std::vector<std::size_t> first_run;  ///< [bin], and the end of the last one's
  std::vector<float> pixels;           ///< usable pixels in a cell, [cell of a run][channel]
  std::vector<float> inverse;          ///< [bin][channel]: 1 / number of usable pixels, 0 if there are none

  std::size_t bins() const { return first_run.size() - 1; }
};

/// The bins of some grids, one grid's after the other's, on a film whose cells are one pixel high and a whole
/// number of pixels wide, with cell borders at the grids' region's upper left corner. A pixel's light is that
/// of the cell that it lies in.
BinWeights bin_weights(const Photo& photo, const std::vector<std::shared_ptr<const BinGrid>>& grids,
                       const sim::FilmGeometry& film);

}  // namespace vegard::fit
