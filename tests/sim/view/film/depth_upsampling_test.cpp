#include "sim/view/film/depth_image.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace vegard::sim::depth_upsampling_test {
namespace {

constexpr int kShrink = 4;

FilmGeometry fine_film() {
  FilmGeometry film;
  film.columns = 26;
  film.rows = 18;
  return film;
}

// Where all rays go on for ever the weights are those of the distance alone, and bilinear interpolation
// leaves a plane as it is: the place of a cell's middle is that of the fine film, but where it lies beyond
// the coarse cells' middles.
TEST(DepthTaps, LeaveAPlaneAsItIs) {
  const FilmGeometry fine = fine_film(), coarse = coarse_film(fine, kShrink);
  const std::vector<float> ends(static_cast<std::size_t>(coarse.columns) * coarse.rows,
                                std::numeric_limits<float>::infinity());
  std::vector<float> plane;
  for (int row = 0; row < coarse.rows; ++row)
    for (int column = 0; column < coarse.columns; ++column)
      plane.push_back(static_cast<float>(kShrink * ((column + 0.5) + 10.0 * (row + 0.5))));
  for (int row = kShrink / 2; row < fine.rows - kShrink / 2; ++row)
    for (int column = kShrink / 2; column < fine.columns - kShrink / 2; ++column) {
      const DepthTaps taps = depth_taps(coarse, kShrink, ends.data(), row, column, ends.front());
      ASSERT_TRUE(taps.matched);
      EXPECT_NEAR(taps.mean(plane.data()), column + 0.5 + 10.0 * (row + 0.5), 1e-4) << row << ", " << column;
    }
}

}  // namespace
}  // namespace vegard::sim::depth_upsampling_test
