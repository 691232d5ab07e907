#include "fit/direction_map_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/base/image_io.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit {
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
}  // namespace vegard::fit
