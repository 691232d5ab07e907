#include "fit/photo/rayleigh/rayleigh_camera.h"

#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::rayleigh_camera_test {
namespace {

using sim::ErrorKind;
using tests::expect_words;

const std::string kCamera = R"(name = "an all-sky camera"
dark_counts = 370.0       # the corners
gain_e_per_count = 1.5
[[filter]]
name = "green"
line_nm = 557.7           # nm
width_nm = 2.0
width_error = 0.03
rayleigh_per_count_s = 24.2
[[filter]]
name = "blue"
line_nm = 427.8
centre_nm = 428.0
width_nm = 2.5
dark_counts = 374.0
channel = "blue"
)";

TEST(RayleighCamera, IsRead) {
  const RayleighCamera camera = parse_rayleigh_camera(kCamera, "folder/camera.toml");
  EXPECT_EQ(camera.name, "an all-sky camera");
  ASSERT_EQ(camera.filters.size(), 2u);
  const RayleighFilter& green = filter_called(camera, "green");
  EXPECT_EQ(green.dark_counts, 370.0);
  EXPECT_EQ(green.band.centre_nm, 557.7);
  EXPECT_EQ(green.factor->value, 24.2);
  EXPECT_EQ(green.factor->error, 0.0);
  const RayleighFilter& blue = filter_called(camera, "blue");
  EXPECT_EQ(blue.dark_counts, 374.0);
  EXPECT_EQ(blue.gain_e_per_count, 1.5);
  EXPECT_EQ(blue.channel, "blue");
  EXPECT_FALSE(blue.factor);
  expect_words(ErrorKind::usage, {"folder/camera.toml", "--filter", "several", "green, blue"},
               [&] { filter_called(camera, ""); });
  expect_words(ErrorKind::usage, {"no filter 'gren'", "green"}, [&] { filter_called(camera, "gren"); });
  const RayleighCamera files = parse_rayleigh_camera(
      "dark = \"d.fits\"\nflat = \"/f.fits\"\n[[filter]]\nname = \"a\"\nline_nm = 630\n", "x/c.toml");
  EXPECT_EQ(files.filters[0].dark_file, "x/d.fits");
  EXPECT_EQ(files.filters[0].flat_file, "/f.fits");
  EXPECT_EQ(&filter_called(files, ""), &files.filters[0]);
}

/// `line` in place of what begins like it, or behind the filter's line_nm.
void refused(const std::string& text, const std::vector<std::string>& words) {
  expect_words(ErrorKind::scene, words, [&] { parse_rayleigh_camera(text, "c.toml"); });
}

TEST(RayleighCamera, TellsWhatIsWrongWhere) {
  const std::string filter = "[[filter]]\nname = \"g\"\nline_nm = 557.7\n";
  refused("", {"c.toml:1", "filter", "there is no filter"});
  refused("name = [\n", {"c.toml", "TOML"});
  refused(filter + "wdth_nm = 2.0\n", {"c.toml:4", "filter.wdth_nm", "unknown key", "width_nm"});
  refused("[[filter]]\nname = \"g\"\n", {"c.toml:1", "filter.line_nm", "missing"});
  refused("[[filter]]\nline_nm = 557.7\n", {"c.toml:1", "filter.name", "missing"});
  refused(filter + filter, {"c.toml:5", "two filters are called 'g'"});
  refused(filter + "width_nm = \"two\"\n", {"c.toml:4", "filter.width_nm", "a number"});
  refused(filter + "width_nm = 0\n", {"c.toml:4", "filter.width_nm", "above 0"});
  refused(filter + "width_nm = 2.0\ncentre_nm = 570.0\n",
          {"c.toml:3", "filter.line_nm", "nothing through at 557.7"});
  refused(filter + "rayleigh_per_count_s = -2\n", {"c.toml:4", "filter.rayleigh_per_count_s"});
  refused(filter + "rayleigh_per_count_s_error = 2\n", {"c.toml:4", "error without its number"});
  refused(filter + "channel = \"grey\"\n", {"c.toml:4", "filter.channel", "\"red\""});
  refused("dark = \"a\"\ndark_counts = 3\n" + filter, {"c.toml:1", "dark", "two dark levels"});
  refused(filter + "gain_e_per_count = 0\n", {"c.toml:4", "filter.gain_e_per_count"});
  refused("[[filter]]\nname = \"uv\"\nline_nm = 391.4\nwidth_nm = 2\n",
          {"c.toml:4", "light of stars is not known"});
  refused("filter = 3\n", {"c.toml:1", "filter", "[[filter]]"});
}

TEST(RayleighCamera, HasCurvesOfFilters) {
  const tests::TemporaryFolder folder;
  tests::put(folder / "curve.csv", "wavelength_nm,transmission\n556,0\n557,0.4\n558,0.4\n559,0\n");
  const std::string text = "[[filter]]\nname = \"g\"\nline_nm = 557.7\ntransmission = \"curve.csv\"\n";
  const RayleighCamera camera = parse_rayleigh_camera(text, folder / "c.toml");
  const FilterBand& band = camera.filters[0].band;
  EXPECT_DOUBLE_EQ(transmission_at(band, 556.5), 0.2);
  EXPECT_EQ(transmission_at(band, 560.0), 0.0);
  EXPECT_NEAR(middle_of_band_nm(band), 557.5, 1e-6);
  // As broad as a rectangle of 2 nm.
  FilterBand rectangle;
  rectangle.line_nm = 557.7;
  rectangle.centre_nm = 557.5;
  rectangle.width_nm = 2.0;
  EXPECT_NEAR(star_photons_in_band(band, 1.0, 0.2) / star_photons_in_band(rectangle, 1.0, 0.2), 1.0, 2e-3);
  tests::put(folder / "curve.csv", "wavelength_nm,transmission\n558,0.4\n557,0.4\n");
  expect_words(ErrorKind::unreadable_input, {"curve.csv:3", "increas"},
               [&] { parse_rayleigh_camera(text, folder / "c.toml"); });
}

TEST(RayleighCamera, TakesAFactorAndKeepsTheRest) {
  const std::string with = with_factor(kCamera, "c.toml", "green", {31.5, 1.25});
  EXPECT_NE(with.find("# the corners"), std::string::npos);
  EXPECT_EQ(with.find("24.2"), std::string::npos);
  const RayleighCamera camera = parse_rayleigh_camera(with, "c.toml");
  EXPECT_EQ(filter_called(camera, "green").factor->value, 31.5);
  EXPECT_EQ(filter_called(camera, "green").factor->error, 1.25);
  EXPECT_EQ(filter_called(camera, "green").band.width_error, 0.03);
  EXPECT_FALSE(filter_called(camera, "blue").factor);
  const std::string both = with_factor(with, "c.toml", "blue", {70.0, 4.0});
  EXPECT_EQ(filter_called(parse_rayleigh_camera(both, "c.toml"), "blue").factor->value, 70.0);
  expect_words(ErrorKind::scene, {"c.toml", "no room"}, [] {
    with_factor("filter = [{ name = \"g\", line_nm = 557.7 }]\n", "c.toml", "g", {1.0, 0.1});
  });
}

}  // namespace
}  // namespace vegard::fit::rayleigh_camera_test
