// The exact Euclidean distance transform of a raster.
//
// Source: Meijster, Roerdink and Hesselink 2000, "A general algorithm for computing distance transforms in
// linear time": along columns by counting, along rows by the lower envelope of parabolas. It is exact, since
// it only uses integers.
#pragma once

#include <cstdint>
#include <vector>

namespace vegard::sim {

/// The result for a raster without a marked cell.
inline constexpr std::uint32_t kNoMark = 0xffffffffu;

/// Returns the square of the distance, in cells, from the centre of every cell to that of the nearest marked
/// cell: [row][column], 0 for marked cells, kNoMark if there are none. `wraps`: the last column is followed
/// by the first. Columns and rows must be fewer than 32768. The result is the same for every number of
/// threads.
std::vector<std::uint32_t> squared_distance(const std::vector<std::uint8_t>& marked, int columns, int rows,
                                            bool wraps = false, int threads = 1);

}  // namespace vegard::sim
