// Strands on grids, against their definition at every voxel.
#include "sim/emit/sun/strand/strand_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/number/random.h"
#include "sim/emit/sun/strand/closest_point.h"

namespace vegard::sim::strand_grid_test {
namespace {

using Place = std::array<double, 3>;
constexpr std::uint64_t kSeed = 11;

SparseGrid grid_with(double voxel, int channels = 1) {
  SparseGrid grid;
  grid.voxel = voxel;
  grid.origin = {-3.3, 2.1, 0.7};
  for (int c = 0; c < channels; ++c) grid.channels.push_back({"channel" + std::to_string(c), ""});
  return grid;
}

Place centre(const SparseGrid& grid, int i, int j, int k) {
  return {grid.origin[0] + grid.voxel * (i + 0.5), grid.origin[1] + grid.voxel * (j + 0.5),
          grid.origin[2] + grid.voxel * (k + 0.5)};
}

Strand<double> random_strand(std::uint32_t n, int pieces, double size) {
  Strand<double> strand;
  for (std::uint32_t p = 0; p < 3u * static_cast<std::uint32_t>(pieces) + 1u; ++p) {
    const Words w = random_words(kSeed, Stream::strand, n, p);
    strand.points.push_back({size * uniform(w[0]), size * uniform(w[1]), size * uniform(w[2])});
  }
  strand.radius_first = 1.6;
  strand.radius_last = 0.8;
  strand.along = {1.0, 0.2, 0.7, 1.5};
  return strand;
}

/// Every voxel of a cube about the strands against their definition; how many are lit.
int compare(const Strands<double>& strands, const SparseGrid& grid, int low, int high, double tolerance) {
  int lit = 0;
  for (int i = low; i < high; ++i)
    for (int j = low; j < high; ++j)
      for (int k = low; k < high; ++k) {
        double expected = 0.0;
        for (const Strand<double>& strand : strands.all)
          expected += density_at(strand, strands.falloff, centre(grid, i, j, k));
        const double is = grid.value(0, i, j, k);
        if (std::abs(is - expected) > tolerance)
          ADD_FAILURE() << i << ' ' << j << ' ' << k << ": " << is << " for " << expected;
        if (expected > 0.0) ++lit;
      }
  return lit;
}

TEST(StrandGrid, IsTheSumOfDensitiesAtVoxelsCentres) {
  for (const RadialFalloff falloff :
       {RadialFalloff::smooth, RadialFalloff::linear, RadialFalloff::gaussian}) {
    Strands<double> strands{falloff, {}};
    for (std::uint32_t n = 0; n < 3; ++n)
      strands.all.push_back(random_strand(n, 1 + static_cast<int>(n), 12.0));
    SparseGrid grid = grid_with(0.5);
    add_strands(strands, {1.0}, {}, grid);
    // Newton's method stops at a millionth of the radius; what is stored is a float.
    EXPECT_GT(compare(strands, grid, -8, 40, 2e-6), 2000);
  }
}

TEST(StrandGrid, IsRightForAnyVoxelAndRadius) {
  for (const double voxel : {0.21, 1.3, 3.0}) {
    const Strands<double> strands{RadialFalloff::smooth, {random_strand(7, 2, 6.0)}};
    SparseGrid grid = grid_with(voxel);
    add_strands(strands, {1.0}, {}, grid);
    EXPECT_GT(compare(strands, grid, -8, static_cast<int>(13.0 / voxel) + 8, 2e-6), 0) << voxel;
  }
}

/// From (0, -1, 0) over x = 3 back to (0, 1, 0), and to the same plane.
Strand<double> hairpin(double radius) {
  return {{{0, -1, 0}, {4, -1, 0}, {4, 1, 0}, {0, 1, 0}}, radius, radius, {1.0, 1.0}};
}

TEST(StrandGrid, LightsAVoxelOnceThatIsAsNearToTwoPartsOfAStrand) {
  // The legs' tubes, of radius 1.5, cover one another about the plane y = 0, where voxels' centres lie.
  const Strands<double> strands{RadialFalloff::smooth, {hairpin(1.5)}};
  SparseGrid grid = grid_with(0.25);
  grid.origin = {-2.0, -0.125, -0.125};
  add_strands(strands, {1.0}, {}, grid);
  compare(strands, grid, -16, 24, 2e-6);
  const int i = 10;  // x = 0.625: both legs are nearly as far as in the middle
  const double expected = density_at(strands.all[0], strands.falloff, centre(grid, i, 0, 0));
  EXPECT_GT(expected, 0.1);
  EXPECT_NEAR(grid.value(0, i, 0, 0), expected, 1e-6);
}

TEST(StrandGrid, OfAStraightStrandHoldsItsIntegral) {
  // Over the tube the integral of (1 - q²)² is a third of the cross-section times the length.
  const Strands<double> strands{
      RadialFalloff::smooth,
      {{{{0.3, 0.1, 0.2}, {3.3, 4.1, 0.2}, {6.3, 8.1, 0.2}, {9.3, 12.1, 0.2}}, 2.0, 2.0, {1.0, 1.0}}}};
  SparseGrid grid = grid_with(0.2);
  add_strands(strands, {1.0}, {}, grid);
  const double expected = 3.14159265358979323846 * 4.0 / 3.0 * 15.0;
  EXPECT_NEAR(grid.sum(0) * std::pow(grid.voxel, 3), expected, 2e-3 * expected);
}

TEST(StrandGrid, EndsFlat) {
  const Strands<double> strands{RadialFalloff::linear,
                                {{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, 2.0, 2.0, {1.0, 1.0}}}};
  SparseGrid grid = grid_with(0.5);
  grid.origin = {-5.0, -5.0, -5.0};
  add_strands(strands, {1.0}, {}, grid);
  EXPECT_EQ(grid.value(0, 9, 10, 10), 0.0f);   // x = -0.25
  EXPECT_GT(grid.value(0, 10, 10, 10), 0.8f);  // x = +0.25
  EXPECT_GT(grid.value(0, 15, 10, 10), 0.8f);  // x = 2.75
  EXPECT_EQ(grid.value(0, 16, 10, 10), 0.0f);  // x = 3.25
}

TEST(StrandGrid, DoesNotDependOnThreadsAndAddsToWhatIsThere) {
  Strands<double> strands;
  for (std::uint32_t n = 0; n < 40; ++n) strands.all.push_back(random_strand(n, 1, 20.0));
  SparseGrid one = grid_with(0.5, 2), many = grid_with(0.5, 2), twice = grid_with(0.5, 2);
  add_strands(strands, {1.0, 3.0}, {1, std::uint64_t{1} << 30}, one);
  add_strands(strands, {1.0, 3.0}, {0, std::uint64_t{1} << 30}, many);
  EXPECT_EQ(one.bricks, many.bricks);
  for (int pass = 0; pass < 2; ++pass) add_strands(strands, {1.0, 3.0}, {}, twice);
  EXPECT_NEAR(twice.sum(0), 2.0 * one.sum(0), 1e-6 * one.sum(0));
  EXPECT_NEAR(one.sum(1), 3.0 * one.sum(0), 1e-6 * one.sum(1));
  for (const auto& [at, brick] : one.bricks)
    EXPECT_TRUE(std::any_of(brick.begin(), brick.end(), [](float x) { return x != 0.0f; }));
}

TEST(StrandGrid, RefusesMoreMemoryThanItMayHave) {
  const Strands<double> strands{RadialFalloff::smooth, {random_strand(1, 1, 20.0)}};
  SparseGrid grid = grid_with(0.1);
  try {
    add_strands(strands, {1.0}, {0, 1 << 18}, grid);
    FAIL() << "it took what it wanted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
  }
}

}  // namespace
}  // namespace vegard::sim::strand_grid_test
