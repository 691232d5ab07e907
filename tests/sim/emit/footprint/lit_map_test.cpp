#include "sim/emit/footprint/lit_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "march_case.h"

namespace vegard::sim::lit_map_test {
namespace {

using namespace march_case;

TEST(LitMap, NeverCallsAPlaceDarkThatIsNot) {
  // Against every lit texel: its light reaches a texel to all sides.
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const int columns = 90, rows = 61;
    std::vector<std::uint8_t> lit(static_cast<std::size_t>(columns) * rows, 0);
    for (int i = 0; i < 5; ++i)
      lit[static_cast<std::size_t>(uniform(seed, i, 1) * rows) * columns +
          static_cast<std::size_t>(uniform(seed, i, 2) * columns)] = 1;
    const LitMap map = plane_lit_map(columns, rows, lit, 2);
    double most = 0.0;
    for (int i = 0; i < 3000; ++i) {
      const double x = 150.0 * uniform(seed, i, 3) - 30.0, y = 120.0 * uniform(seed, i, 4) - 30.0;
      double nearest = 1e9;
      for (int t = 0; t < columns * rows; ++t)
        if (lit[t] != 0)
          nearest = std::min(nearest, std::hypot(std::max(0.0, std::abs(x - t % columns) - 1.0),
                                                 std::max(0.0, std::abs(y - t / columns) - 1.0)));
      EXPECT_LE(map.dark_texels(x, y), nearest) << x << " " << y;
      most = std::max(most, map.dark_texels(x, y));
    }
    EXPECT_GT(most, 8.0);  // but it does call places dark
  }
}

TEST(LitMap, KnowsTheLightAcrossTheEdgesOfACube) {
  const int n = 64;
  for (int lit_face = 0; lit_face < 6; ++lit_face) {
    std::array<std::vector<std::uint8_t>, 6> lit;
    for (auto& face : lit) face.assign(static_cast<std::size_t>(n + 2) * (n + 2), 0);
    // A texel by the middle of an edge: (u, v) about (1, 0).
    lit[lit_face][static_cast<std::size_t>(n / 2) * (n + 2) + n] = 1;
    const std::vector<LitMap> maps = cube_lit_maps(n, lit, 1);
    const int axis = lit_face / 2, beside = 2 * ((axis + 1) % 3);
    // On the neighbour that lies at u = 1, the place that is next to it, and one by the far edge.
    double d[3] = {0.0, 0.0, 0.0};
    d[axis] = lit_face % 2 == 0 ? 0.98 : -0.98;
    d[(axis + 1) % 3] = 1.0;
    const int a = beside / 2;
    const double near_x = (d[(a + 1) % 3] + 1.0) * 0.5 * n + 0.5,
                 near_y = (d[(a + 2) % 3] + 1.0) * 0.5 * n + 0.5;
    EXPECT_EQ(maps[beside].dark_texels(near_x, near_y), 0.0);
    EXPECT_GT(maps[beside].dark_texels(n + 1 - near_x, n + 1 - near_y), 0.0);
    EXPECT_GT(maps[beside].dark_texels(0.5 * n, 0.5 * n), 0.0);
  }
}

}  // namespace
}  // namespace vegard::sim::lit_map_test
