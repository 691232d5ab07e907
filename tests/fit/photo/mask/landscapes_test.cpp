// Skylines of made landscapes of many kinds, whose truth is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fit/photo/mask/horizon.h"
#include "tests/support/made_landscape.h"

namespace vegard::fit::landscapes_test {
namespace {

class Landscapes : public testing::TestWithParam<tests::Landscape> {};

// Of every kind three draws, all found; so many columns within six pixels of the truth as the kind allows:
// the tips of trees are narrower than what a path over columns and a median of five pixels see, some columns
// to each tree. Measured: 0.92 to 0.98 with trees, 0.97 and more without.
TEST_P(Landscapes, HaveASkyline) {
  const tests::Landscape& kind = GetParam();
  for (std::uint64_t seed = 101; seed <= 103; ++seed) {
    const tests::MadeLandscape made = tests::made_landscape(kind, 720, 480, seed);
    const std::optional<HorizonFound> found = find_horizon(made.photo);
    ASSERT_TRUE(found) << seed;
    EXPECT_GE(tests::share_right(found->horizon.y_px, made.skyline_px, 6.0),
              kind.tree_height > 0.0 ? 0.88 : 0.95)
        << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(AllKinds, Landscapes, testing::ValuesIn(tests::landscapes()), [](const auto& given) {
  std::string name = given.param.name;
  name.erase(std::remove_if(name.begin(), name.end(),
                            [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }),
             name.end());
  return name;
});

// The rim of an all-sky lens is a dark ground below a brighter sky, and is none.
TEST(FisheyesRim, IsNoSkyline) {
  Photo circle = tests::even_sky(480, 480, 0.002f);
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 480; ++x)
      if (std::hypot(x + 0.5 - 240.0, y + 0.5 - 238.0) < 215.0)
        for (int c = 0; c < 3; ++c) circle.linear.at(x, y, c) = 0.1f;
  tests::add_noise(circle, 0.001, 7);
  EXPECT_FALSE(find_horizon(circle));
}

}  // namespace
}  // namespace vegard::fit::landscapes_test
