// [[fit.radar]]: in and out of a scene file, and what is refused.
#include <gtest/gtest.h>

#include <string>

#include "sim/scene/file/scene_toml.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::radar_scene_test {
namespace {

const char* const kScene = R"([[sheet]]
[fit]
free = ["sheet.main.energy_kev"]
[[fit.radar]]
file = "radars/pfisr.h5"
beam = 64157
time_s = 1206515030
azimuth_deg = -154.3
elevation_deg = 77.5
site_latitude_deg = 65.13
site_longitude_deg = -147.47
scale_sigma = 0.1
[[fit.radar]]
name = "eiscat"
file = "density.csv"
latitude_deg = 69.0
longitude_deg = 19.0
lowest_km = 90
highest_km = 140
seconds = 30
)";

TEST(RadarEntries, AreWrittenAsTheyWereRead) {
  for (const Scene& scene :
       {parse_scene(kScene, "a.toml"), parse_scene(write_scene(parse_scene(kScene, "a.toml")), "b.toml")}) {
    ASSERT_EQ(scene.fit.radars.size(), 2u);
    const RadarEntry &first = scene.fit.radars[0], &second = scene.fit.radars[1];
    EXPECT_EQ(first.name, "pfisr") << "the file's name without its ending";
    EXPECT_EQ(first.file, "radars/pfisr.h5");
    EXPECT_EQ(first.beam, 64157.0);
    EXPECT_EQ(first.time_s, 1206515030.0);
    EXPECT_EQ(first.azimuth_deg, -154.3);
    EXPECT_EQ(first.scale_sigma, 0.1);
    EXPECT_FALSE(first.seconds);
    EXPECT_EQ(second.name, "eiscat");
    EXPECT_EQ(second.latitude_deg, 69.0);
    EXPECT_EQ(second.lowest_km, 90.0);
    EXPECT_EQ(second.highest_km, 140.0);
    EXPECT_EQ(second.seconds, 30.0);
    EXPECT_FALSE(second.scale_sigma);
  }
}

struct RadarRefusal {
  const char *name, *text, *facts;
};

class RadarRefusals : public testing::TestWithParam<RadarRefusal> {};

TEST_P(RadarRefusals, NameWhatIsWrong) {
  const std::string text = tests::expect_error(ErrorKind::scene, [] {
    parse_scene(std::string("[[sheet]]\n[[fit.radar]]\n") + GetParam().text, "a.toml");
  });
  EXPECT_TRUE(tests::has_facts(text, GetParam().facts));
}

INSTANTIATE_TEST_SUITE_P(
    All, RadarRefusals,
    testing::Values(
        RadarRefusal{"no_file", "name = \"a\"\n", "a.toml:2 | fit.radar | file"},
        RadarRefusal{"unknown_key", "file = \"a.csv\"\nazimut_deg = 3\n",
                     "a.toml:4 | did you mean 'azimuth_deg'?"},
        RadarRefusal{"text", "file = \"a.csv\"\nbeam = \"3\"\n", "a.toml:4 | beam"},
        RadarRefusal{"half_a_place", "file = \"a.csv\"\nlatitude_deg = 3\n", "latitude_deg | longitude_deg"},
        RadarRefusal{"half_a_beam", "file = \"a.csv\"\nelevation_deg = 30\n", "elevation_deg | azimuth_deg"},
        RadarRefusal{
            "place_and_beam",
            "file = \"a.csv\"\nlatitude_deg = 3\nlongitude_deg = 3\nazimuth_deg = 3\nelevation_deg = 30\n",
            "latitude_deg | azimuth_deg"},
        RadarRefusal{"site_alone", "file = \"a.csv\"\nsite_latitude_deg = 3\nsite_longitude_deg = 3\n",
                     "site | azimuth_deg"},
        RadarRefusal{"altitudes", "file = \"a.csv\"\nlowest_km = 120\nhighest_km = 110\n",
                     "lowest_km | highest_km"},
        RadarRefusal{"low", "file = \"a.csv\"\nelevation_deg = 3\nazimuth_deg = 3\n",
                     "elevation_deg | 10 to 90"},
        RadarRefusal{"sigma", "file = \"a.csv\"\nscale_sigma = 0\n", "scale_sigma | 0.001"},
        RadarRefusal{"twice", "file = \"a.csv\"\n[[fit.radar]]\nfile = \"b/a.csv\"\n", "a.toml:4 | 'a'"}),
    [](const testing::TestParamInfo<RadarRefusal>& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace vegard::sim::radar_scene_test
