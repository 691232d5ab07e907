// What is seen of the made landscape.
#include "sim/render/ground/landscape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "sim/base/number/constants.h"

namespace vegard::sim::landscape_test {
namespace {

constexpr double kStep_rad = 0.002;

std::vector<LandscapePoint> seen_from(const Landscape& landscape, double azimuth_deg, double lowest_sine) {
  std::vector<LandscapePoint> seen;
  landscape.look(azimuth_deg * kRadiansPerDegree, lowest_sine, kStep_rad, seen);
  return seen;
}

TEST(Landscape, IsAPlainOfSnowWithWoodsAndHillsAround) {
  const Landscape landscape(21);
  int hills = 0, woods = 0;
  for (int azimuth = 0; azimuth < 360; azimuth += 10) {
    const std::vector<LandscapePoint> seen = seen_from(landscape, azimuth, -1.0);
    ASSERT_GT(seen.size(), 200u);
    EXPECT_LT(seen.front().sine, -0.99f);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      EXPECT_TRUE(i == 0 || seen[i].sine > seen[i - 1].sine) << azimuth << ' ' << i;
      EXPECT_GE(seen[i].snow, 0.0f);
      EXPECT_LE(seen[i].snow, 1.0f);
      EXPECT_GT(seen[i].light, 0.0f);
      EXPECT_LE(seen[i].light, 1.25f);
      EXPECT_LT(seen[i].light * seen[i].snow, 1.0001f);  // snow reflects no more than it gets
      EXPECT_TRUE(seen[i].distance_m > 150.0f || seen[i].snow == 1.0f) << azimuth << ' ' << i;
    }
    // Nothing is seen beyond the end of the sky.
    EXPECT_GT(seen.back().sine, -1e-3f);
    EXPECT_LT(seen.back().sine, Landscape::kHighestSine);
    hills += seen.back().sine > 0.01f ? 1 : 0;
    woods +=
        std::any_of(seen.begin(), seen.end(), [](const LandscapePoint& point) { return point.snow < 0.3f; })
            ? 1
            : 0;
  }
  EXPECT_GE(hills, 5);
  EXPECT_GE(woods, 25);
}

// Also between trees, which stand differently by each seed.
TEST(Landscape, ReflectsNoMoreThanItGets) {
  for (int seed = 1; seed <= 6; ++seed) {
    const Landscape landscape(static_cast<std::uint64_t>(seed));
    for (int azimuth = 0; azimuth < 360; azimuth += 6)
      for (const LandscapePoint& point : seen_from(landscape, azimuth, -0.2))
        ASSERT_LT(point.light * point.snow, 1.0001f) << seed << ' ' << azimuth << ' ' << point.distance_m;
  }
}

// Where the search begins does not matter to what lies above.
TEST(Landscape, IsTheSameWhereverTheViewBegins) {
  const Landscape landscape(3);
  const std::vector<LandscapePoint> all = seen_from(landscape, 75.0, -1.0),
                                    above = seen_from(landscape, 75.0, -0.1);
  EXPECT_LT(above.size(), all.size());
  EXPECT_LE(above.front().sine, -0.1f);
  EXPECT_NEAR(above.back().sine, all.back().sine, 0.003);
  EXPECT_NE(seen_from(Landscape(4), 75.0, -0.1).back().sine, above.back().sine);
}

}  // namespace
}  // namespace vegard::sim::landscape_test
