#include "sim/base/number/distance_transform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

#include "sim/base/number/random.h"

namespace vegard::sim::distance_transform_test {
namespace {

std::vector<std::uint8_t> random_marks(int columns, int rows, double share, std::uint32_t seed) {
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(columns) * rows, 0);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const Words words = philox4x32({static_cast<std::uint32_t>(i), 0, 0, 0}, {seed, 0});
    marks[i] = words[0] < share * 4294967296.0 ? 1 : 0;
  }
  return marks;
}

std::vector<std::uint32_t> by_brute_force(const std::vector<std::uint8_t>& marks, int columns, int rows,
                                          bool wraps) {
  std::vector<std::uint32_t> all(marks.size(), kNoMark);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
          if (marks[static_cast<std::size_t>(y) * columns + x] == 0) continue;
          int across = std::abs(x - c);
          if (wraps) across = std::min(across, columns - across);
          const auto square = static_cast<std::uint32_t>(across * across + (y - r) * (y - r));
          auto& least = all[static_cast<std::size_t>(r) * columns + c];
          least = std::min(least, square);
        }
  return all;
}

TEST(DistanceTransform, IsTheNearestMarkOfAll) {
  // From crowded to so few that columns, rows and whole rasters are without a mark.
  for (const double share : {0.5, 0.05, 0.004, 0.001})
    for (std::uint32_t seed = 1; seed <= 6; ++seed)
      for (const bool wraps : {false, true}) {
        const int columns = 37 + static_cast<int>(seed), rows = 23 + static_cast<int>(2 * seed);
        const auto marks = random_marks(columns, rows, share, seed);
        EXPECT_EQ(squared_distance(marks, columns, rows, wraps, 2),
                  by_brute_force(marks, columns, rows, wraps))
            << share << " " << seed << " " << wraps;
      }
}

TEST(DistanceTransform, ReachesAcrossTheSeamOnlyWhereItIsTold) {
  std::vector<std::uint8_t> marks(10, 0);
  marks[0] = 1;
  EXPECT_EQ(squared_distance(marks, 10, 1, false)[9], 81u);
  EXPECT_EQ(squared_distance(marks, 10, 1, true)[9], 1u);
}

TEST(DistanceTransform, KnowsARasterWithoutAMark) {
  for (const std::uint32_t square : squared_distance(std::vector<std::uint8_t>(12, 0), 4, 3))
    EXPECT_EQ(square, kNoMark);
}

TEST(DistanceTransform, KeepsItsWholeNumbersOverALongRow) {
  std::vector<std::uint8_t> marks(32767, 0);
  marks[0] = 1;
  EXPECT_EQ(squared_distance(marks, 32767, 1)[32766], 32766u * 32766u);
  EXPECT_EQ(squared_distance(marks, 1, 32767)[32766], 32766u * 32766u);
}

}  // namespace
}  // namespace vegard::sim::distance_transform_test
