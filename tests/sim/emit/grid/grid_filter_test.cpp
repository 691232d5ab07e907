// Convolution of sparse grids against a plain one, and what it keeps.
#include "sim/emit/grid/grid_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/random.h"

namespace vegard::sim::grid_filter_test {
namespace {

constexpr std::uint64_t kSeed = 5;

SparseGrid dark_grid(int channels = 1) {
  SparseGrid grid;
  for (int c = 0; c < channels; ++c) grid.channels.push_back({"channel" + std::to_string(c), ""});
  return grid;
}

void set(SparseGrid& grid, int channel, int i, int j, int k, float value) {
  grid.brick({i >> 3, j >> 3,
              k >> 3})[channel * SparseGrid::kVoxels + SparseGrid::within(i & 7, j & 7, k & 7)] = value;
}

/// Voxels at random about the corner of eight bricks.
SparseGrid random_grid() {
  SparseGrid grid = dark_grid(2);
  for (std::uint32_t n = 0; n < 300; ++n) {
    const Words w = random_words(kSeed, Stream::strand, n);
    const auto place = [](std::uint32_t word) { return static_cast<int>(word % 20u) - 10; };
    set(grid, static_cast<int>(n % 2), place(w[0]), place(w[1]), place(w[2]),
        static_cast<float>(uniform(w[3])));
  }
  return grid;
}

Mask5 random_mask() {
  Mask5 mask;
  for (std::uint32_t n = 0; n < Mask5::kWeights; ++n)
    mask.weights[n] = uniform(random_words(kSeed, Stream::bundle, n)[0]);
  return mask;
}

double plainly(const SparseGrid& grid, const Mask5& mask, int channel, int i, int j, int k) {
  double sum = 0.0;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z)
        sum +=
            mask.weights[Mask5::at(x, y, z)] * static_cast<double>(grid.value(channel, i - x, j - y, k - z));
  return sum;
}

TEST(GridFilter, IsTheConvolutionWithTheMask) {
  const SparseGrid before = random_grid();
  for (const Mask5& mask : {blur_mask(), sharpen_mask(), random_mask()}) {
    SparseGrid after = before;
    filter_grid(after, mask, 2);
    for (int c = 0; c < 2; ++c)
      for (int i = -14; i < 14; ++i)
        for (int j = -14; j < 14; ++j)
          for (int k = -14; k < 14; k += 3)
            // Of some 125 products of floats below 2.
            ASSERT_NEAR(after.value(c, i, j, k), std::max(0.0, plainly(before, mask, c, i, j, k)), 5e-6)
                << i << ' ' << j << ' ' << k;
  }
}

TEST(GridFilter, OfOneVoxelIsTheMaskInItsPlace) {
  const Mask5 mask = random_mask();
  SparseGrid grid = dark_grid();
  set(grid, 0, 7, -8, 3, 1.0f);
  filter_grid(grid, mask, 1);
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = -2; k <= 2; ++k)
        EXPECT_EQ(grid.value(0, 7 + i, -8 + j, 3 + k), static_cast<float>(mask.weights[Mask5::at(i, j, k)]));
  EXPECT_EQ(grid.bricks.size(), 4u) << "over the border along x and y, not along z";
}

TEST(GridFilter, BlurKeepsTheSumOfEveryChannel) {
  SparseGrid grid = random_grid();
  const double before[2] = {grid.sum(0), grid.sum(1)};
  for (int pass = 0; pass < 3; ++pass) filter_grid(grid, blur_mask(), 2);
  for (int c = 0; c < 2; ++c) EXPECT_NEAR(grid.sum(c), before[c], 1e-5 * before[c]);
}

TEST(GridFilter, BlurDampsAndSharpenRaisesAWaveByItsLength) {
  // Of a wave of n voxels' length, blur leaves b = cos(pi / n)^4, and sharpen 2 - b.
  SparseGrid grid = dark_grid();
  constexpr double kTurn = 2.0 * 3.14159265358979323846 / 32.0;
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 8; ++j)
      for (int k = 0; k < 8; ++k) set(grid, 0, i, j, k, static_cast<float>(2.0 + std::cos(kTurn * i)));
  SparseGrid blurred = grid, sharp = grid;
  filter_grid(blurred, blur_mask(), 1);
  filter_grid(sharp, sharpen_mask(), 1);
  const double kept = std::pow(std::cos(kTurn / 2.0), 4);
  EXPECT_NEAR(blurred.value(0, 32, 4, 4), 2.0 + kept * std::cos(kTurn * 32), 1e-6);
  EXPECT_NEAR(sharp.value(0, 32, 4, 4), 2.0 + (2.0 - kept) * std::cos(kTurn * 32), 1e-6);
}

TEST(GridFilter, DoesNotDependOnThreads) {
  SparseGrid one = random_grid(), many = random_grid();
  filter_grid(one, sharpen_mask(), 1);
  filter_grid(many, sharpen_mask(), 0);
  EXPECT_EQ(one.bricks, many.bricks);
}

TEST(GridFilter, OfNothingIsNothing) {
  SparseGrid grid = dark_grid();
  filter_grid(grid, blur_mask(), 1);
  EXPECT_TRUE(grid.bricks.empty());
  grid.brick({0, 0, 0});
  filter_grid(grid, blur_mask(), 1);
  EXPECT_TRUE(grid.bricks.empty());
}

}  // namespace
}  // namespace vegard::sim::grid_filter_test
