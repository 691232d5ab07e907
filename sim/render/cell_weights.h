// Weights with which the cells of a film enter means of light.
//
// A mean may be over any set of cells: a row of a band, a strip along the elevation or along the field, a
// cell of a coarse picture. Code that uses these weights must not assume that a mean is a row.
#pragma once

#include <cstddef>
#include <vector>

namespace vegard::sim {

/// Sparse weights [mean][cell][channel]. A mean in a channel is the sum over its cells of pixels * light,
/// times `inverse`.
struct CellWeights {
  /// Neighbouring cells of one film row, a part of a mean.
  struct Run {
    int row = 0, first_column = 0, columns = 0;
    std::size_t first_pixels = 0;  ///< of the run's first cell, an index into `pixels`; 3 per cell
  };
  std::vector<Run> runs;               ///< mean after mean
  std::vector<std::size_t> first_run;  ///< [mean], and one more: the end of the last mean's runs
  std::vector<float> pixels;           ///< weight of a cell as a number of pixels, [cell of a run][channel]
  std::vector<float> inverse;          ///< [mean][channel]: 1 / number of pixels, 0 if there are none

  std::size_t means() const { return first_run.size() - 1; }
};

}  // namespace vegard::sim
