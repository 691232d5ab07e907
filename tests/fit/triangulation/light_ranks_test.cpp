#include "fit/triangulation/light_ranks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sim/base/number/constants.h"

namespace vegard::fit::light_ranks_test {
namespace {

// A sum of 2 a + 1 equal parts of independent numbers falls to a half at a lag of a and a half: at a + 1 in
// whole steps. Seed 47.
TEST(LightRanks, CountIndependentValues) {
  constexpr std::size_t kRows = 120, kColumns = 80, kDown = 3, kAcross = 1;
  std::mt19937_64 random(47);
  std::normal_distribution<double> normal;
  std::vector<double> noise((kRows + 2 * kDown) * (kColumns + 2 * kAcross));
  for (double& one : noise) one = normal(random);
  std::vector<double> grid(kRows * kColumns, 0.0);
  for (std::size_t row = 0; row < kRows; ++row)
    for (std::size_t column = 0; column < kColumns; ++column)
      for (std::size_t y = 0; y <= 2 * kDown; ++y)
        for (std::size_t x = 0; x <= 2 * kAcross; ++x)
          grid[row * kColumns + column] += noise[(row + y) * (kColumns + 2 * kAcross) + column + x];
  const double lags = (kDown + 1.0) * (kAcross + 1.0);
  EXPECT_DOUBLE_EQ(independent_values(grid, kRows, kColumns), kRows * kColumns / (2.27 * lags));
  // Unknown values do not count.
  for (std::size_t row = 0; row < kRows; ++row) grid[row * kColumns] = sim::kNaN;
  EXPECT_DOUBLE_EQ(independent_values(grid, kRows, kColumns), kRows * (kColumns - 1) / (2.27 * lags));
  EXPECT_DOUBLE_EQ(independent_values({sim::kNaN, sim::kNaN}, 1, 2), 0.0);
}

}  // namespace
}  // namespace vegard::fit::light_ranks_test
