// The exact Euclidean distance transform of a raster.
//
// Source: Meijster, Roerdink and Hesselink 2000, "A general algorithm for computing distance transforms in
// linear time": down the columns by counting, along the rows by the lower envelope of parabolas. All in whole
// numbers, so that it is exact.
#pragma once

#include <cstdint>
#include <vector>

namespace vegard::sim {

/// Of a raster without a single mark.
inline constexpr std::uint32_t kNoMark = 0xffffffffu;

/// The square of the distance, in cells, from the middle of every cell to that of the nearest one that is
/// marked: [row][column], 0 for the marked ones, kNoMark if there are none. `wraps`: the last column is
/// followed by the first. Columns and rows must be fewer than 32768. The same for every number of threads.
std::vector<std::uint32_t> squared_distance(const std::vector<std::uint8_t>& marked, int columns, int rows,
                                            bool wraps = false, int threads = 1);

}  // namespace vegard::sim
