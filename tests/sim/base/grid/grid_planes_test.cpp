// Slices and largest numbers of sparse grids, against a look at every voxel.
#include "sim/base/grid/grid_planes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/base/number/random.h"

namespace vegard::grid_planes_test {
namespace {

using namespace sim;

/// 200 voxels here and there, some below 0, of the second of two channels.
SparseGrid scattered() {
  SparseGrid grid;
  grid.channels = {{"other", ""}, {"density", ""}};
  for (std::uint32_t n = 0; n < 200; ++n) {
    const auto words = random_words(7, Stream::path, n, 0, 0);
    const int at[3] = {static_cast<int>(words[0] % 40) - 17, static_cast<int>(words[1] % 29) - 9,
                       static_cast<int>(words[2] % 23) + 3};
    auto& brick = grid.brick({at[0] >> 3, at[1] >> 3, at[2] >> 3});
    const int v = SparseGrid::within(at[0] & 7, at[1] & 7, at[2] & 7);
    brick[SparseGrid::kVoxels + v] = static_cast<float>(n % 50) - 5.0f;
    brick[v] = 1e6f;
  }
  return grid;
}

TEST(GridPlanes, AreTheLargestNumbersOfTheirVoxels) {
  const SparseGrid grid = scattered();
  const auto box = lit_box(grid, 1);
  ASSERT_TRUE(box.has_value());
  for (const int bin : {1, 3})
    for (int axis = 0; axis < 3; ++axis)
      for (const bool whole : {true, false}) {
        const int layer = (box->low[axis] + box->high[axis]) / 2;
        const GridPlane plane =
            whole ? largest_along(grid, 1, *box, axis, bin) : slice_at(grid, 1, *box, axis, layer, bin);
        EXPECT_EQ(plane.width, (box->size(plane.across) + bin - 1) / bin);
        EXPECT_EQ(plane.height, (box->size(plane.up) + bin - 1) / bin);
        std::vector<float> expected(plane.value.size(), 0.0f);
        for (int x = box->low[0]; x < box->high[0]; ++x)
          for (int y = box->low[1]; y < box->high[1]; ++y)
            for (int z = box->low[2]; z < box->high[2]; ++z) {
              const int voxel[3] = {x, y, z};
              if (!whole && voxel[axis] != layer) continue;
              const int column = (voxel[plane.across] - box->low[plane.across]) / bin;
              const int from_below = (voxel[plane.up] - box->low[plane.up]) / bin;
              float& pixel = expected[(plane.height - 1 - from_below) * plane.width + column];
              pixel = std::max(pixel, grid.value(1, x, y, z));
            }
        EXPECT_EQ(plane.value, expected) << axis << " " << bin << " " << whole;
        EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 0.0f);
      }
}

TEST(GridPlanes, KnowTheirAxes) {
  SparseGrid grid;
  grid.channels = {{"density", ""}};
  grid.brick({0, 0, 0})[SparseGrid::within(1, 2, 3)] = 4.0f;
  grid.brick({0, 0, 0})[SparseGrid::within(7, 6, 4)] = 5.0f;
  const auto box = lit_box(grid, 0);
  ASSERT_TRUE(box.has_value());
  EXPECT_EQ(box->low, (std::array<int, 3>{1, 2, 3}));
  EXPECT_EQ(box->high, (std::array<int, 3>{8, 7, 5}));
  const GridPlane along_y = largest_along(grid, 0, *box, 1, 1);  // x across, z up
  EXPECT_EQ(along_y.value.front(), 0.0f);
  EXPECT_EQ(along_y.value.back(), 0.0f);
  EXPECT_EQ(along_y.value[6], 5.0f);              // upper right
  EXPECT_EQ(along_y.value[along_y.width], 4.0f);  // lower left
}

TEST(GridPlanes, AGridOfZerosHasNoBox) {
  SparseGrid grid;
  grid.channels = {{"density", ""}};
  EXPECT_FALSE(lit_box(grid, 0).has_value());
  grid.brick({0, 0, 0});
  EXPECT_FALSE(lit_box(grid, 0).has_value());
}

TEST(GridPlanes, FarBricksTakeNoMoreThanTheirPicture) {
  SparseGrid grid;
  grid.channels = {{"density", ""}};
  grid.brick({0, 0, 0})[0] = 1.0f;
  grid.brick({100000, 100000, 100000})[0] = 2.0f;
  const auto box = lit_box(grid, 0);
  const int bin = bin_for(*box, 600);
  const GridPlane plane = largest_along(grid, 0, *box, 2, bin);
  EXPECT_LE(plane.width, 600);
  EXPECT_GT(plane.width, 500);
  EXPECT_EQ(plane.value[plane.width - 1], 2.0f);
  EXPECT_EQ(plane.value[static_cast<std::size_t>(plane.height - 1) * plane.width], 1.0f);
  EXPECT_EQ(bin_for({{0, 0, 0}, {600, 1, 1}}, 600), 1);
  EXPECT_EQ(bin_for({{0, 0, 0}, {601, 1, 1}}, 600), 2);
}

}  // namespace
}  // namespace vegard::grid_planes_test
