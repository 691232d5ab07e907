// What bricks on their way into an OpenVDB file take of memory.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/base/grid/sparse_grid.h"

namespace vegard::sim {

/// Bytes of a brick of so many quantities, with a colour of three numbers or without.
inline std::uint64_t vdb_bytes_of_brick(std::size_t channels, bool with_colour) {
  constexpr std::uint64_t kRest = 200;  // what a leaf and its place in a tree take beside the numbers
  return channels * (sizeof(float) * SparseGrid::kVoxels + kRest) +
         (with_colour ? 3 * sizeof(float) * SparseGrid::kVoxels + kRest : 0);
}

}  // namespace vegard::sim
