// Which pixels the bins of each grid hold.
#include "fit/measure/bin_grid.h"
#include "fit/measure/profile_bins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "fit/measure/profile.h"
#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::bin_grid_test {
namespace {

const Region kRegion{20, 10, 121, 97};

/// Bin of every pixel of the region; -1 where none. Fails if a pixel is in two.
std::vector<int> bin_of_pixels(const BinGrid& grid) {
  std::vector<int> of(static_cast<std::size_t>(kRegion.width) * kRegion.height, -1);
  for (std::size_t b = 0; b < grid.bins(); ++b)
    for (std::size_t r = grid.first_run[b]; r < grid.first_run[b + 1]; ++r)
      for (int x = grid.runs[r].begin; x < grid.runs[r].end; ++x) {
        int& bin = of[static_cast<std::size_t>(grid.runs[r].y - kRegion.y) * kRegion.width + x - kRegion.x];
        EXPECT_EQ(bin, -1);
        bin = static_cast<int>(b);
      }
  return of;
}

TEST(BinGrid, ColumnsAreRowsOfBands) {
  const BinGrid grid = column_bins(kRegion, 5);
  const std::vector<int> of = bin_of_pixels(grid);
  for (int y = 0; y < kRegion.height; ++y)
    for (int x = 0; x < kRegion.width; ++x) {
      const int bin = of[static_cast<std::size_t>(y) * kRegion.width + x];
      ASSERT_GE(bin, 0);
      EXPECT_EQ(bin % grid.positions, y);
      EXPECT_EQ(grid.row[bin], y);
      const int band = bin / grid.positions;
      EXPECT_GE(x + kRegion.x, band_begin(kRegion, 5, band));
      EXPECT_LT(x + kRegion.x, band_begin(kRegion, 5, band + 1));
    }
}

TEST(BinGrid, ColumnsMayHaveBinsOfSeveralRows) {
  const BinGrid grid = column_bins(kRegion, 5, 4);
  EXPECT_EQ(grid.positions, 25);  // 24 of four rows, and one of the last row of 97
  EXPECT_EQ(grid.position_px, 4.0);
  const std::vector<int> of = bin_of_pixels(grid);
  for (int y = 0; y < kRegion.height; ++y)
    for (int x = 0; x < kRegion.width; ++x)
      ASSERT_EQ(of[static_cast<std::size_t>(y) * kRegion.width + x] % grid.positions, y / 4);
  EXPECT_EQ(grid.row[0], 1.5);
  EXPECT_EQ(grid.row[24], 96.0);
}

TEST(BinGrid, AlongElevationABinHasTheElevationsOfItsRowAtTheMiddleColumn) {
  sim::Camera camera = tests::small_scene().camera;
  camera.roll_deg = 8.0;
  const BinGrid grid = elevation_bins(kRegion, 4, camera);
  const auto elevation = [&](double x, double y) {
    return sim::direction_of_pixel(camera, x, y).elevation_deg;
  };
  const double middle = kRegion.x + 0.5 * kRegion.width;
  const std::vector<int> of = bin_of_pixels(grid);
  int some = 0;
  for (int y = 0; y < kRegion.height; ++y)
    for (int x = 0; x < kRegion.width; ++x) {
      const int bin = of[static_cast<std::size_t>(y) * kRegion.width + x];
      const double here = elevation(kRegion.x + x + 0.5, kRegion.y + y + 0.5);
      if (bin < 0) {
        EXPECT_TRUE(here > elevation(middle, kRegion.y) ||
                    here <= elevation(middle, kRegion.y + kRegion.height));
        continue;
      }
      ++some;
      const int position = bin % grid.positions;
      EXPECT_LE(here, elevation(middle, kRegion.y + position) + 1e-9);
      EXPECT_GE(here, elevation(middle, kRegion.y + position + 1) - 1e-9);
    }
  EXPECT_GT(some, kRegion.width * kRegion.height * 3 / 4);
}

/// An all-sky camera with north at the picture's top: elevation rises downwards there, and falls again in the
/// south. Either way a pixel is at the row where the middle column has its elevation.
TEST(BinGrid, ElevationRunsFromWhicheverSideTheHorizonIs) {
  sim::Camera camera;
  camera.model = sim::LensModel::equidistant;
  camera.width = camera.height = 200;
  camera.focal_px = 100.0 / 1.5707963267948966;
  camera.elevation_deg = 90.0;
  const auto elevation = [&](double x, double y) {
    return sim::direction_of_pixel(camera, x, y).elevation_deg;
  };
  for (const Region& region : {Region{60, 10, 70, 70}, Region{60, 120, 70, 70}}) {
    const BinGrid grid = elevation_bins(region, 3, camera);
    const double middle = region.x + 0.5 * region.width;
    int some = 0;
    for (std::size_t bin = 0; bin < grid.bins(); ++bin) {
      const int row = region.y + static_cast<int>(bin) % grid.positions;
      const double one = elevation(middle, row), other = elevation(middle, row + 1);
      for (std::size_t r = grid.first_run[bin]; r < grid.first_run[bin + 1]; ++r)
        for (int x = grid.runs[r].begin; x < grid.runs[r].end; ++x, ++some) {
          const double here = elevation(x + 0.5, grid.runs[r].y + 0.5);
          EXPECT_GE(here, std::min(one, other) - 1e-9);
          EXPECT_LE(here, std::max(one, other) + 1e-9);
        }
    }
    EXPECT_GT(some, region.width * region.height / 2) << region.y;
  }
}

/// Two points of one field line, 100 and 130 km high, fall into one band: those of a sloping field, seen
/// aside.
TEST(BinGrid, BandsAlongTheFieldHoldFieldLines) {
  const sim::Scene scene = [] {
    sim::Scene s = tests::small_scene();
    s.field.inclination_deg = 70.0;
    s.field.declination_deg = 25.0;
    return s;
  }();
  constexpr int kBands = 11;
  const BinGrid grid = field_bins(kRegion, kBands, scene.camera, scene.field);
  const std::vector<int> of = bin_of_pixels(grid);
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  const double i = scene.field.inclination_deg * sim::kRadiansPerDegree,
               d = scene.field.declination_deg * sim::kRadiansPerDegree;
  const double down[3] = {std::cos(i) * std::sin(d), std::cos(i) * std::cos(d), -std::sin(i)};
  const auto band_of = [&](const double* enu) {
    double camera[3] = {0.0, 0.0, 0.0};
    for (int r = 0; r < 3; ++r)
      for (int k = 0; k < 3; ++k) camera[r] += view.camera_from_enu[r][k] * enu[k];
    const int x = static_cast<int>(
                      std::floor(0.5 * scene.camera.width + view.lens.focal_px * camera[0] / camera[2])) -
                  kRegion.x,
              y = static_cast<int>(
                      std::floor(0.5 * scene.camera.height + view.lens.focal_px * camera[1] / camera[2])) -
                  kRegion.y;
    if (x < 0 || x >= kRegion.width || y < 0 || y >= kRegion.height) return -1;
    const int bin = of[static_cast<std::size_t>(y) * kRegion.width + x];
    EXPECT_TRUE(bin < 0 || bin % grid.positions == y);
    return bin < 0 ? -1 : bin / grid.positions;
  };
  int pairs = 0, alike = 0;
  std::set<int> bands;
  for (double east = -120.0; east <= 120.0; east += 1.5) {
    const double low[3] = {east, 190.0, 100.0};
    const double high[3] = {east - 30.0 * down[0] / -down[2], 190.0 - 30.0 * down[1] / -down[2], 130.0};
    const int one = band_of(low), other = band_of(high);
    if (one < 0 || other < 0) continue;
    ++pairs;
    alike += one == other;
    bands.insert(one);
  }
  // A pixel's centre may lie on the other side of a border than the point: half a pixel of 11 to either side.
  EXPECT_GT(pairs, 40);
  EXPECT_GE(alike, pairs * 8 / 10);
  EXPECT_GT(bands.size(), 6u);
  // Columns would not do: over 30 km the lines cross several of them.
  const double low[3] = {0.0, 190.0, 100.0},
               high[3] = {-30.0 * down[0] / -down[2], 190.0 - 30.0 * down[1] / -down[2], 130.0};
  EXPECT_EQ(band_of(low), band_of(high));
}

TEST(BinGrid, StripsAndCellsTakeTheBandOfTheirCentre) {
  const BinGrid profiles = column_bins(kRegion, 5);
  const BinGrid strips = horizontal_bins(profiles, 4), cells = image_bins(profiles, 10);
  EXPECT_EQ(strips.groups, 4);
  EXPECT_EQ(strips.positions, 5 * 3) << "24 columns a band, bins of eight";
  for (const int bin : bin_of_pixels(strips)) EXPECT_GE(bin, 0);
  for (std::size_t b = 0; b < strips.bins(); ++b)
    EXPECT_EQ(strips.band[b], static_cast<int>(b % strips.positions) / 3);
  EXPECT_EQ(cells.groups, 9);
  EXPECT_EQ(cells.positions, 12);
  EXPECT_EQ(cells.row[0], 4.5);
  EXPECT_EQ(cells.band[cells.bin(3, 11)], 4);
}

TEST(BinGrid, RefusesWhatItCannotDraw) {
  sim::Scene scene = tests::small_scene();
  scene.fit.bands = 4;
  scene.fit.profile_along = sim::ProfileAlong::field;
  scene.field.model = sim::FieldModel::dipole;
  const std::string text = tests::expect_error(sim::ErrorKind::scene, [&] { profile_bins(scene, kRegion); });
  EXPECT_NE(text.find("fit.profile_along"), std::string::npos) << text;
}

}  // namespace
}  // namespace vegard::fit::bin_grid_test
