// Convolution of a grid with a mask of 5 x 5 x 5: blur, sharpen (row C15 of the source), or a user's own
// mask.
#pragma once

#include "sim/base/grid/sparse_grid.h"
#include "sim/base/number/mask5.h"

namespace vegard::sim {

/// Replaces every channel by its convolution with the mask: value(v) = sum over o of mask(o) value(v - o).
/// Bricks are added where the mask reaches beyond the present ones, and bricks without light are removed. If
/// the mask has negative weights, negative results are set to 0, as there is no negative light. Except for
/// that, the sum of a channel is multiplied by the sum of the mask. The bits do not depend on `threads` (0:
/// all cores). The function takes the memory of the grid and of its result, less that of bricks already
/// finished.
void filter_grid(SparseGrid& grid, const Mask5& mask, int threads);

}  // namespace vegard::sim
