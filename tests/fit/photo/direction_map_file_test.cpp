#include "fit/photo/direction_map_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "sim/base/picture/image_io.h"
#include "tests/support/expect_error.h"
#include "tests/support/source_folder.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::direction_map_file_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Maps with numbers that a file could spoil: an azimuth that is 0, one just below 360, below the horizon.
sim::DirectionMap odd_map() {
  sim::DirectionMap map;
  map.width = 3;
  map.height = 2;
  map.azimuth_deg = {0.0f, 359.99997f, kNaN, 90.5f, 180.0f, 271.25f};
  map.elevation_deg = {10.0f, 0.0f, kNaN, -5.5f, 90.0f, 45.125f};
  return map;
}

void expect_equal(const sim::DirectionMap& a, const sim::DirectionMap& b) {
  ASSERT_EQ(a.width, b.width);
  ASSERT_EQ(a.height, b.height);
  for (std::size_t i = 0; i < a.azimuth_deg.size(); ++i) {
    if (std::isnan(a.azimuth_deg[i])) {
      EXPECT_TRUE(std::isnan(b.azimuth_deg[i]) && std::isnan(b.elevation_deg[i])) << i;
      continue;
    }
    EXPECT_EQ(a.azimuth_deg[i], b.azimuth_deg[i]) << i;
    EXPECT_EQ(a.elevation_deg[i], b.elevation_deg[i]) << i;
  }
}

TEST(DirectionMapFile, ComesBackFromAnExrAsItWas) {
  const tests::TemporaryFolder folder;
  const std::string both = folder / "both.exr";
  const sim::DirectionMap map = odd_map();
  tests::put(both, encode_direction_map(map, both));
  expect_equal(map, read_direction_map(both, both));

  // A file for each, whatever its only channel is called.
  sim::Image azimuth(map.width, map.height, {"Y"}), elevation(map.width, map.height, {"whatever"});
  azimuth.data = map.azimuth_deg;
  elevation.data = map.elevation_deg;
  sim::write_exr(folder / "az.exr", azimuth, {});
  sim::write_exr(folder / "el.exr", elevation, {});
  expect_equal(map, read_direction_map(folder / "az.exr", folder / "el.exr"));
}

TEST(DirectionMapFile, ComesBackFromFitsAsItWas) {
  const tests::TemporaryFolder folder;
  const sim::DirectionMap map = odd_map();
  const FitsMaps files = encode_fits_maps(map);
  tests::put(folder / "az.FIT", files.azimuth);
  tests::put(folder / "el.fits", files.elevation);
  expect_equal(map, read_direction_map(folder / "az.FIT", folder / "el.fits"));
  constexpr std::size_t kWithinTheNumbers = 2890;  // a header of 2880 bytes, 24 of numbers, blanks
  tests::put(folder / "cut.fits", files.azimuth.substr(0, kWithinTheNumbers));
  for (const char* name : {"cut.fits", "none.fits"})
    EXPECT_NE(tests::expect_error(sim::ErrorKind::unreadable_input,
                                  [&] { read_angles(folder / name, "azimuth_deg"); })
                  .find(name),
              std::string::npos);
}

// What the maps of one team hold, docs/keograms.md: they look straight up between two rows, and not below ten
// degrees.
TEST(DirectionMapFile, PublishedMapsAreReadAsTheyAreMeant) {
  const char* const named = std::getenv("VEGARD_PHOTOS");
  const std::filesystem::path photos =
      named != nullptr ? named : std::filesystem::path(tests::source_folder()) / "../shared/photos";
  const std::string base = (photos / "dasc/PKR_DASC_0558_20150213_").string();
  if (!std::filesystem::exists(base + "Az.FIT")) GTEST_SKIP() << "no photographs at " << photos;
  const sim::DirectionMap map = read_direction_map(base + "Az.FIT", base + "El.FIT");
  ASSERT_EQ(map.width, 512);
  ASSERT_EQ(map.height, 512);
  float lowest = 90.0f, highest = 0.0f;
  std::size_t at = 0, nowhere = 0;
  for (std::size_t i = 0; i < map.elevation_deg.size(); ++i) {
    if (std::isnan(map.elevation_deg[i])) {
      ++nowhere;
      continue;
    }
    lowest = std::min(lowest, map.elevation_deg[i]);
    if (map.elevation_deg[i] > highest) at = i;
    highest = std::max(highest, map.elevation_deg[i]);
  }
  EXPECT_EQ(nowhere, 105322u);
  EXPECT_EQ(lowest, 10.0f);
  EXPECT_NEAR(highest, 89.82, 0.005);
  EXPECT_EQ(at % 512, 243u);
  EXPECT_EQ(at / 512, 511u - 249u) << "the first row that is stored is the lowest";
  // As one sees it lying on the back: a quarter turn counter-clockwise, from the right to the top, is a
  // quarter turn to the east.
  const float right = map.azimuth_deg[map.index(343, 262)], top = map.azimuth_deg[map.index(243, 162)];
  EXPECT_NEAR(std::remainder(top - right - 90.0, 360.0), 0.0, 1.0);
}

TEST(DirectionMapFile, RefusesFilesThatHoldNoAngles) {
  const tests::TemporaryFolder folder;
  sim::Image picture(4, 3, {"R", "G", "B"});
  sim::write_exr(folder / "picture.exr", picture, {});
  sim::write_display(folder / "picture.tif", picture, 16, 92, {});
  for (const char* name : {"picture.exr", "picture.tif", "missing.exr", "notes.txt"})
    EXPECT_NE(tests::expect_error(sim::ErrorKind::unreadable_input,
                                  [&] { read_angles(folder / name, "azimuth_deg"); })
                  .find(name),
              std::string::npos);
}

}  // namespace
}  // namespace vegard::fit::direction_map_file_test
