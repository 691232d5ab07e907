// Profiles against elevation in sectors of azimuth, of skies whose light is known.
#include "fit/measure/direction_bins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "fit/measure/direction_profile.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"
#include "tests/support/expect_error.h"
#include "tests/support/fisheye_map.h"

namespace vegard::fit::direction_bins_test {
namespace {

constexpr int kSize = 300;
constexpr double kRadius = 145.0;
const Region kAll{0, 0, kSize, kSize};

/// Linear in elevation; a different slope and level in every direction and channel.
double light(double azimuth_deg, double elevation_deg, int channel) {
  const double turn = std::cos((azimuth_deg - 70.0) * sim::kRadiansPerDegree);
  return (1.0 + channel) * (0.2 + 0.1 * turn + (0.004 + 0.002 * turn) * elevation_deg);
}

Photo sky(const sim::DirectionMap& map, double noise, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Photo photo;
  photo.linear = sim::Image(map.width, map.height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = false;
  photo.file_name = "sky.tif";
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const std::size_t i = map.index(x, y);
        // Where the camera sees nothing there is light that no profile may have.
        const double value =
            std::isnan(map.elevation_deg[i]) ? 1e3 : light(map.azimuth_deg[i], map.elevation_deg[i], c);
        photo.linear.at(x, y, c) = static_cast<float>(value + (noise > 0.0 ? noise * normal(random) : 0.0));
      }
  return photo;
}

/// Mean of light() over the pixels of the bin, from the map alone.
double expected(const sim::DirectionMap& map, const DirectionSectors& sectors, int sector, int position,
                int c) {
  double sum = 0.0, pixels = 0.0;
  for (std::size_t i = 0; i < map.azimuth_deg.size(); ++i) {
    const double low = sectors.lowest_deg + position * sectors.step_deg;
    if (!(map.elevation_deg[i] >= low && map.elevation_deg[i] < low + sectors.step_deg)) continue;
    const double off = std::remainder(map.azimuth_deg[i] - sectors.azimuths_deg[sector], 360.0);
    if (std::abs(off) >= 0.5 * sectors.width_deg) continue;
    sum += light(map.azimuth_deg[i], map.elevation_deg[i], c);
    pixels += 1.0;
  }
  return sum / pixels;
}

TEST(DirectionBins, ProfileIsTheSkysLightInEveryDirection) {
  const sim::DirectionMap map = tests::fisheye_map(kSize, kRadius);
  DirectionSectors sectors;
  sectors.azimuths_deg = {0.0, 70.0, 160.0, 250.0, -45.0};  // the first lies across 360
  sectors.width_deg = 12.0;
  sectors.lowest_deg = 10.0;
  sectors.step_deg = 2.0;
  const DirectionProfile measured =
      direction_profile(sky(map, 0.0, 0), map, kAll, sectors, {0.0, 0.0, 0.0}, "maps");
  ASSERT_EQ(measured.profile.bands, 5);
  ASSERT_EQ(measured.profile.rows, 40);
  for (int sector = 0; sector < 5; ++sector)
    for (int position = 0; position < 30; position += 5)
      for (int c = 0; c < 3; ++c) {
        const double mean = measured.profile.mean[measured.profile.index(sector, position, c)];
        EXPECT_NEAR(mean, expected(map, sectors, sector, position, c), 1e-6);
        // Within the sector the light is that of its middle to the second order in its width: 0.2 %.
        const double middle =
            light(sectors.azimuths_deg[sector], elevation_of_position_deg(sectors, position), c);
        EXPECT_NEAR(mean, middle, 0.006 * middle) << sector << " " << position << " " << c;
      }
}

TEST(DirectionBins, APixelIsInOneBinAndAllThatLookAboveAreInSome) {
  const sim::DirectionMap map = tests::fisheye_map(kSize, kRadius);
  const DirectionSectors sectors = even_sectors(7);
  const BinGrid grid = direction_bins(map, kAll, sectors);
  std::set<std::size_t> seen;
  for (const BinGrid::Run& run : grid.runs)
    for (int x = run.begin; x < run.end; ++x) EXPECT_TRUE(seen.insert(map.index(x, run.y)).second);
  std::size_t above = 0;
  for (const float elevation : map.elevation_deg) above += std::isfinite(elevation) ? 1 : 0;
  EXPECT_EQ(seen.size(), above);
}

// 400 bins with noise of a known size: that each is told within its own error, on the whole. The sum of 400
// squared deviations in units of the error has a standard deviation of 7 %, the error's own error a few
// per cent: a fifth either way is four of the former. Seed 20151007.
TEST(DirectionBins, ErrorsAreThoseOfTheNoise) {
  const sim::DirectionMap map = tests::fisheye_map(kSize, kRadius);
  DirectionSectors sectors = even_sectors(8);
  sectors.step_deg = 1.5;
  const DirectionProfile measured =
      direction_profile(sky(map, 0.05, 20151007), map, kAll, sectors, {0.0, 0.0, 0.0}, "maps");
  const DirectionProfile clean =
      direction_profile(sky(map, 0.0, 0), map, kAll, sectors, {0.0, 0.0, 0.0}, "maps");
  double squares = 0.0, ratios = 0.0;
  int bins = 0;
  for (int sector = 0; sector < 8; ++sector)
    for (int position = 0; position < 50; ++position, ++bins) {
      const std::size_t i = measured.profile.index(sector, position, 1);
      const double off =
          (measured.profile.mean[i] - clean.profile.mean[i]) / measured.profile.standard_error[i];
      squares += off * off;
      const Ratio noisy = channel_ratio(measured.profile, sector, position, 0, 1);
      const Ratio right = channel_ratio(clean.profile, sector, position, 0, 1);
      ratios += std::pow((noisy.value - right.value) / noisy.sigma, 2);
    }
  EXPECT_NEAR(squares / bins, 1.0, 0.2);
  EXPECT_NEAR(ratios / bins, 1.0, 0.2);
}

TEST(DirectionBins, RatiosAreThoseOfTheLightAboveTheDarkLevel) {
  const sim::DirectionMap map = tests::fisheye_map(kSize, kRadius);
  Photo photo = sky(map, 0.0, 0);
  for (std::size_t i = 0; i < photo.linear.data.size(); ++i) photo.linear.data[i] += 4.0f;
  const DirectionProfile measured =
      direction_profile(photo, map, kAll, even_sectors(4), {4.0, 4.0, 4.0}, "maps");
  for (int sector = 0; sector < 4; ++sector)
    for (int position = 0; position < 80; position += 10) {
      EXPECT_NEAR(channel_ratio(measured.profile, sector, position, 0, 1).value, 0.5, 1e-5);
      EXPECT_NEAR(channel_ratio(measured.profile, sector, position, 2, 1).value, 1.5, 1e-5);
    }
  EXPECT_TRUE(std::isnan(
      channel_ratio(direction_profile(photo, map, kAll, even_sectors(4), {0.0, 9.0, 0.0}, "maps").profile, 0,
                    5, 0, 1)
          .value))
      << "of no light at all";
}

TEST(DirectionBins, TheTableHoldsTheSame) {
  const sim::DirectionMap map = tests::fisheye_map(kSize, kRadius);
  const Photo photo = sky(map, 0.01, 1);
  const DirectionProfile measured =
      direction_profile(photo, map, kAll, even_sectors(3), {0.0, 0.0, 0.0}, "maps az.exr");
  const std::string csv = direction_profile_csv(photo, measured);
  EXPECT_NE(csv.find("# directions: maps az.exr\n"), std::string::npos);
  const sim::CsvTable table = sim::read_csv_table(csv, "table");
  ASSERT_EQ(table.rows(), 3u * 90u);
  EXPECT_EQ(table.column("azimuth_deg")[95], 120.0);
  EXPECT_EQ(table.column("elevation_deg")[95], 5.5);
  EXPECT_EQ(table.column("g")[95], measured.profile.mean[measured.profile.index(1, 5, 1)]);
  EXPECT_EQ(table.column("sigma_r_over_g")[95], channel_ratio(measured.profile, 1, 5, 0, 1).sigma);
}

/// A camera 400 km up that looks along the limb: elevation falls from -10 to -22 degrees over the rows.
sim::DirectionMap limb_map() {
  sim::DirectionMap map;
  map.width = map.height = 120;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      map.azimuth_deg.push_back(static_cast<float>(0.1 * x));
      map.elevation_deg.push_back(static_cast<float>(-10.0 - 0.1 * (y + 0.5)));
    }
  return map;
}

TEST(DirectionBins, AlongTangentAltitudeLightIsWhereItsLinesPass) {
  const sim::DirectionMap map = limb_map();
  Photo photo = sky(map, 0.0, 0);
  constexpr double kAbove = 100.0;  // no light is below zero
  for (std::size_t i = 0; i < map.elevation_deg.size(); ++i)
    for (int c = 0; c < 3; ++c)
      photo.linear.data[3 * i + c] =
          static_cast<float>(kAbove + sim::tangent_altitude_km(400.0, map.elevation_deg[i]));
  DirectionSectors sectors;
  sectors.azimuths_deg = {3.0, 9.0};
  sectors.width_deg = 5.0;
  sectors.observer_km = 400.0;
  sectors.tangent = TangentSteps{-20.0, 220.0, 8.0};
  const DirectionProfile measured =
      direction_profile(photo, map, {0, 0, 120, 120}, sectors, {0.0, 0.0, 0.0}, "maps");
  ASSERT_EQ(measured.profile.rows, 30);
  for (int sector = 0; sector < 2; ++sector)
    for (int position = 0; position < 30; ++position) {
      const double middle_km = -16.0 + 8.0 * position;
      EXPECT_NEAR(tangent_of_position_km(sectors, position), middle_km, 1e-9);
      EXPECT_NEAR(sim::tangent_altitude_km(400.0, elevation_of_position_deg(sectors, position)), middle_km,
                  1e-9);
      // Rows are at most 4.4 km apart: a step of 8 km holds one or two, which are inside of it.
      EXPECT_NEAR(measured.profile.mean[measured.profile.index(sector, position, 1)], kAbove + middle_km,
                  4.0);
    }
  const sim::CsvTable table = sim::read_csv_table(direction_profile_csv(photo, measured), "table");
  EXPECT_EQ(table.column("tangent_altitude_km")[1], -8.0);
}

TEST(DirectionBins, TheGreenLayerOfTheLimbIsTold) {
  const sim::DirectionMap map = limb_map();
  Photo photo = sky(map, 0.0, 0);
  for (std::size_t i = 0; i < map.elevation_deg.size(); ++i)
    for (int c = 0; c < 3; ++c)
      photo.linear.data[3 * i + c] =
          c == 1 ? static_cast<float>(1e-3 *
                                      limb_column_km(sim::tangent_altitude_km(400.0, map.elevation_deg[i]),
                                                     97.0, 91.0, 107.0))
                 : 0.0f;
  DirectionSectors sectors;
  sectors.azimuths_deg = {6.0};
  sectors.width_deg = 12.0;
  sectors.observer_km = 400.0;
  sectors.tangent = TangentSteps{0.0, 200.0, 4.5};
  const DirectionProfile measured =
      direction_profile(photo, map, {0, 0, 120, 120}, sectors, {0.0, 0.0, 0.0}, "maps");
  const auto layers = green_limb_layers(measured);
  ASSERT_TRUE(layers.front());
  // Rows 4.3 km apart fall anywhere in steps of 4.5 km, which are told by their middles: 1.3 km rms.
  EXPECT_NEAR(layers.front()->peak_km, 97.0, 2.0);
  EXPECT_NE(direction_profile_csv(photo, measured).find("# green_layer: azimuth 6\u00b0: emission 9"),
            std::string::npos);
}

TEST(DirectionBins, RefusesSectorsThatAreNone) {
  const sim::DirectionMap map = tests::fisheye_map(60, 29.0);
  const auto refused = [&](const DirectionSectors& sectors) {
    return tests::expect_error(sim::ErrorKind::usage, [&] { direction_bins(map, {0, 0, 60, 60}, sectors); });
  };
  EXPECT_NE(refused({{355.0, 5.0}, 20.0}).find("overlap"), std::string::npos);
  EXPECT_NE(refused({{0.0}, -1.0}).find("--azimuth-width"), std::string::npos);
  EXPECT_NE(refused({{0.0}, 10.0, 0.0, 0.0}).find("--elevation-step"), std::string::npos);
  EXPECT_NE(refused({{0.0}, 10.0, 90.0}).find("--lowest"), std::string::npos);
  EXPECT_NE(refused({{}, 10.0}).find("--azimuths"), std::string::npos);
  DirectionSectors limb{{0.0}, 10.0};
  limb.tangent = TangentSteps{};
  EXPECT_NE(refused(limb).find("site.altitude_m"), std::string::npos) << "an observer of unknown height";
  limb.observer_km = 200.0;
  EXPECT_NE(refused(limb).find("--tangent-range"), std::string::npos) << "250 km are above the observer";
  limb.tangent = TangentSteps{0.0, 100.0, 0.0};
  EXPECT_NE(refused(limb).find("--tangent-step"), std::string::npos);
  EXPECT_NE(tests::expect_error(sim::ErrorKind::usage,
                                [&] {
                                  direction_bins(map, {0, 0, 30, 30}, {{180.0}, 10.0});
                                })
                .find("no pixel"),
            std::string::npos)
      << "the picture's upper left is the north-east";
}

}  // namespace
}  // namespace vegard::fit::direction_bins_test
