// Which pixels a keogram's column is made of.
#include "fit/measure/keogram_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"
#include "tests/support/expect_error.h"
#include "tests/support/fisheye_map.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::keogram_line_test {
namespace {

constexpr int kSize = 240;
constexpr double kRadius = 115.0;
const Region kAll{0, 0, kSize, kSize};

/// Calls visit(place, x, y) for every pixel of the line.
template <class Visit>
void for_each_pixel(const KeogramLine& line, const Visit& visit) {
  const BinGrid& grid = *line.grid;
  for (std::size_t b = 0; b < grid.bins(); ++b)
    for (std::size_t r = grid.first_run[b]; r < grid.first_run[b + 1]; ++r)
      for (int x = grid.runs[r].begin; x < grid.runs[r].end; ++x)
        visit(static_cast<int>(b), x, grid.runs[r].y);
}

/// Mean column and row of a place's pixels, in pixel coordinates.
std::pair<double, double> centre_of(const KeogramLine& line, int place) {
  double x_sum = 0.0, y_sum = 0.0, pixels = 0.0;
  for_each_pixel(line, [&](int b, int x, int y) {
    if (b != place) return;
    x_sum += x + 0.5;
    y_sum += y + 0.5;
    pixels += 1.0;
  });
  return {x_sum / pixels, y_sum / pixels};
}

int place_near(const KeogramLine& line, double position) {
  int best = 0;
  for (int p = 1; p < static_cast<int>(line.position.size()); ++p)
    if (std::abs(line.position[p] - position) < std::abs(line.position[best] - position)) best = p;
  return best;
}

TEST(KeogramLine, AColumnIsTheMiddleOfTheRegion) {
  const KeogramLine line = column_line({10, 20, 31, 40}, 5);
  ASSERT_EQ(line.position.size(), 40u);
  EXPECT_EQ(line.position.front(), 20.0);
  EXPECT_EQ(line.position.back(), 59.0);
  int pixels = 0;
  for_each_pixel(line, [&](int place, int x, int y) {
    EXPECT_EQ(y, 20 + place);
    EXPECT_GE(x, 23);
    EXPECT_LT(x, 28);
    ++pixels;
  });
  EXPECT_EQ(pixels, 200);
  EXPECT_EQ(column_line({10, 20, 31, 40}, 0).width, 31.0);
  tests::expect_error(sim::ErrorKind::usage, [] { column_line({10, 20, 31, 40}, 32); });
}

// An equidistant fisheye shows a vertical plane as a straight line through its middle, and equal angles as
// equal distances: where every place must be is known.
TEST(KeogramLine, AMeridianRunsStraightThroughAFisheyesZenith) {
  const sim::DirectionMap map = tests::fisheye_map(kSize, kRadius);
  for (const double azimuth : {0.0, 30.0, 90.0, 200.0}) {
    const KeogramLine line = meridian_line(map, kAll, {azimuth, {}, {}});
    EXPECT_TRUE(line.of_directions);
    EXPECT_EQ(line.azimuth_deg, azimuth);
    EXPECT_LT(line.position.front(), line.step) << "the horizon that is asked for is at the top";
    EXPECT_GT(line.position.back(), 180.0 - line.step);
    for (const double angle : {10.0, 45.0, 90.0, 120.0, 165.0}) {
      const int place = place_near(line, angle);
      const auto [x, y] = centre_of(line, place);
      const double outwards = (90.0 - line.position[place]) / 90.0 * kRadius;
      const double turn = azimuth * sim::kRadiansPerDegree;
      // The mean of some pixels of a strip lies within half a pixel of its middle.
      EXPECT_NEAR(x, 0.5 * kSize - outwards * std::sin(turn), 0.5) << azimuth << " " << angle;
      EXPECT_NEAR(y, 0.5 * kSize - outwards * std::cos(turn), 0.5) << azimuth << " " << angle;
    }
  }
}

TEST(KeogramLine, EveryPlaceHasPixelsUnlessAskedFinerThanThey) {
  const sim::DirectionMap map = tests::fisheye_map(kSize, kRadius);
  const auto empty_places = [](const KeogramLine& line) {
    int empty = 0;
    for (std::size_t b = 0; b < line.grid->bins(); ++b)
      empty += line.grid->first_run[b] == line.grid->first_run[b + 1] ? 1 : 0;
    return empty;
  };
  for (const double azimuth : {0.0, 17.0, 45.0})
    EXPECT_EQ(empty_places(meridian_line(map, kAll, {azimuth, {}, {}})), 0) << azimuth;
  EXPECT_GT(empty_places(meridian_line(map, kAll, {0.0, 1.0, 0.05})), 0);
}

// Of a camera that looks to the north at 38 degrees, rolled: angles are elevations, the highest at the top.
TEST(KeogramLine, OfACameraThatLooksAtOneSideAnglesAreElevations) {
  sim::Camera camera = tests::small_scene().camera;
  camera.roll_deg = 9.0;
  const sim::DirectionMap map = sim::direction_map(camera);
  const Region all{0, 0, camera.width, camera.height};
  const KeogramLine line = meridian_line(map, all, {7.0, {}, {}});
  EXPECT_GT(line.position.front(), line.position.back());
  int pixels = 0;
  for_each_pixel(line, [&](int place, int x, int y) {
    const sim::Direction seen = sim::direction_of_pixel(camera, x + 0.5, y + 0.5);
    // Beside the plane by at most a degree, the angle along it differs from the elevation in the second
    // order.
    EXPECT_NEAR(seen.elevation_deg, line.position[place], 0.5 * line.step + 0.02);
    const double off = std::remainder(seen.azimuth_deg - 7.0, 360.0);
    EXPECT_LE(std::abs(off) * std::cos(seen.elevation_deg * sim::kRadiansPerDegree), 0.5 * line.width + 1e-3);
    ++pixels;
  });
  EXPECT_GT(pixels, 100);

  // The other horizon is behind the camera: the same pixels, by the same elevations.
  const KeogramLine other = meridian_line(map, all, {187.0, {}, {}});
  EXPECT_NEAR(other.azimuth_deg, 7.0, 1e-9);
  EXPECT_EQ(other.position, line.position);
}

TEST(KeogramLine, RefusesWhatThePictureDoesNotShow) {
  const sim::Camera camera = tests::small_scene().camera;
  const sim::DirectionMap map = sim::direction_map(camera);
  const Region all{0, 0, camera.width, camera.height};
  const auto refused = [&](const MeridianOptions& options) {
    return tests::expect_error(sim::ErrorKind::usage, [&] { meridian_line(map, all, options); });
  };
  EXPECT_NE(refused({94.0, {}, {}}).find("--azimuth"), std::string::npos);
  EXPECT_NE(refused({4.0, -1.0, {}}).find("--width"), std::string::npos);
  EXPECT_NE(refused({4.0, {}, 0.0}).find("--elevation-step"), std::string::npos);
}

}  // namespace
}  // namespace vegard::fit::keogram_line_test
