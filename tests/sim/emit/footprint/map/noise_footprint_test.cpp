#include "sim/emit/footprint/map/make_footprint.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vegard::sim::noise_footprint_test {
namespace {

Footprint noise(double coverage) {
  Footprint f;
  f.source = FootprintSource::noise;
  f.size_km = {800.0, 600.0};
  f.cell_km = 8.0;
  f.noise_coverage = coverage;
  return f;
}

/// Share of the box's area that is brighter than a hundredth.
double share(const PlaneFootprint<double>& plane) {
  const auto& flux = plane.grid.flux_mw_m2;
  return static_cast<double>(std::count_if(flux.begin(), flux.end(), [](double x) { return x > 0.01; })) /
         static_cast<double>(plane.grid.cells());
}

TEST(NoiseFootprint, CoversAboutAsMuchAsItIsToldTo) {
  // A cell above the dark level is below a hundredth in the first 6 % of the way to the brightest, and near
  // the edges: some fifth of them is lost, more of those that are there where little is.
  for (const double coverage : {0.1, 0.3, 0.6})
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u}) {
      const double covered = share(noise_plane(noise(coverage), seed, 0, 0.0, 2));
      EXPECT_LT(covered, 1.1 * coverage) << seed;
      EXPECT_GT(covered, 0.5 * coverage) << seed;
    }
  EXPECT_TRUE(noise_plane(noise(0.0), 1, 0, 0.0, 1).grid.flux_mw_m2.empty());
}

TEST(NoiseFootprint, FadesTowardsTheEdgesAndStaysBetween0And1) {
  const PlaneFootprint<double> plane = noise_plane(noise(0.9), 7, 0, 0.0, 1);
  const auto at = [&](int c, int r) { return plane.grid.flux_mw_m2[r * plane.grid.columns + c]; };
  double most = 0.0, at_edge = 0.0;
  for (int r = 0; r < plane.grid.rows; ++r)
    for (int c = 0; c < plane.grid.columns; ++c) {
      EXPECT_GE(at(c, r), 0.0);
      most = std::max(most, at(c, r));
      if (c == 0 || r == 0 || c == plane.grid.columns - 1 || r == plane.grid.rows - 1)
        at_edge = std::max(at_edge, at(c, r));
    }
  EXPECT_LE(most, 1.0);
  EXPECT_GT(most, 0.7);
  // Half a cell of 8 km from the edge: 4 of the 75 km over which it fades, 3 (4 / 75)² = 0.008.
  EXPECT_LT(at_edge, 0.01);
}

TEST(NoiseFootprint, IsTheSameOnAFinerGridAndForAnyNumberOfThreads) {
  Footprint fine = noise(0.4);
  fine.cell_km = 8.0 / 3.0;
  const PlaneFootprint<double> coarse = noise_plane(noise(0.4), 3, 1, 0.0, 1),
                               finer = noise_plane(fine, 3, 1, 0.0, 2);
  ASSERT_EQ(finer.grid.columns, 3 * coarse.grid.columns);
  for (int r = 0; r < coarse.grid.rows; r += 7)
    for (int c = 0; c < coarse.grid.columns; c += 7)
      EXPECT_NEAR(coarse.grid.flux_mw_m2[r * coarse.grid.columns + c],
                  finer.grid.flux_mw_m2[(3 * r + 1) * finer.grid.columns + 3 * c + 1], 1e-9);
  EXPECT_EQ(noise_plane(noise(0.4), 3, 1, 0.0, 2).grid.flux_mw_m2, coarse.grid.flux_mw_m2);
  EXPECT_NE(noise_plane(noise(0.4), 3, 0, 0.0, 2).grid.flux_mw_m2, coarse.grid.flux_mw_m2);
}

}  // namespace
}  // namespace vegard::sim::noise_footprint_test
