// Skymaps: what GDL has saved (tests/data/imagers/make_skymap.pro), and FITS of two planes.
#include "fit/photo/sky_map_file.h"

#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/base/picture/fits_io.h"
#include "tests/support/expect_error.h"
#include "tests/support/source_folder.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::sky_map_file_test {
namespace {

using sim::ErrorKind;
using tests::expect_words;

std::string made(const std::string& name) { return tests::source_folder() + "/tests/data/imagers/" + name; }

TEST(SkyMapFile, IsReadOfAnIdlSave) {
  for (const char* name : {"skymap.sav", "skymap_packed.sav"}) {
    const SkyMapFile read = read_sky_map(made(name));
    ASSERT_EQ(read.map.width, 6);
    ASSERT_EQ(read.map.height, 4);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 6; ++x) {
        EXPECT_EQ(read.map.azimuth_deg[read.map.index(x, y)], 10.0f * y + x);
        EXPECT_EQ(read.map.elevation_deg[read.map.index(x, y)], 20.0f + 5 * y + 0.5f * x);
      }
    EXPECT_EQ(read.arrays, "skymap/full_azimuth, skymap/full_elevation");
    ASSERT_TRUE(read.place);
    EXPECT_EQ(read.place->latitude_deg, 56.375);
    EXPECT_EQ(read.place->longitude_deg, -94.75);
    EXPECT_EQ(read.place->altitude_m, 35.0);
  }
}

TEST(SkyMapFile, IsFlippedByRowsAndColumns) {
  for (const bool rows : {false, true})
    for (const bool columns : {false, true}) {
      const sim::DirectionMap map = read_sky_map(made("skymap.sav"), {rows, columns}).map;
      for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 6; ++x)
          EXPECT_EQ(map.azimuth_deg[map.index(x, y)], 10.0f * (rows ? 3 - y : y) + (columns ? 5 - x : x));
    }
}

TEST(SkyMapFile, IsReadOfTwoPlanesOfFits) {
  tests::TemporaryFolder folder;
  sim::Image image(3, 2, {"a", "b"});
  for (int i = 0; i < 6; ++i) {
    image.data[2 * i] = 100.0f + i;
    image.data[2 * i + 1] = 40.0f + i;
  }
  sim::write_fits(folder / "sky.fits", image, {});
  const SkyMapFile read = read_sky_map(folder / "sky.fits");
  ASSERT_EQ(read.map.azimuth_deg.size(), 6u);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(read.map.azimuth_deg[i], 100.0f + i);
    EXPECT_EQ(read.map.elevation_deg[i], 40.0f + i);
  }
  EXPECT_FALSE(read.place);
  sim::write_fits(folder / "one.fits", sim::Image(3, 2, {"a"}), {});
  expect_words(ErrorKind::unreadable_input, {"one.fits", "one plane", "--azimuth-map"},
               [&] { read_sky_map(folder / "one.fits"); });
}

TEST(SkyMapFile, IsRefusedWithoutAngles) {
  expect_words(ErrorKind::unreadable_input, {"asi.cdf", "azimuth", "CDF"},
               [] { read_sky_map(made("asi.cdf")); });
  expect_words(ErrorKind::unreadable_input, {"stack.mat", "elevation"},
               [] { read_sky_map(made("stack.mat")); });
}

}  // namespace
}  // namespace vegard::fit::sky_map_file_test
