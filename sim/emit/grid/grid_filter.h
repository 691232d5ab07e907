// Convolution of a grid with a mask of 5 x 5 x 5: blur, sharpen (row C15 of the source), or what a user has.
#pragma once

#include "sim/base/grid/sparse_grid.h"
#include "sim/base/number/mask5.h"

namespace vegard::sim {

/// Every channel becomes its convolution with the mask: value(v) = sum over o of mask(o) value(v - o). Bricks
/// grow where the mask reaches over, and those without light go. Where the mask has weights below 0, what
/// comes out below 0 is taken as 0: there is no negative light. Sums of channels are multiplied by the mask's
/// but for that. The bits do not depend on `threads` (0: all cores). Takes the memory of the grid and of its
/// result but for bricks that are done with.
void filter_grid(SparseGrid& grid, const Mask5& mask, int threads);

}  // namespace vegard::sim
