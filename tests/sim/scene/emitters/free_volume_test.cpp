// Which numbers of volumes may be free, and what is said of those that a scene has no use for.
#include <gtest/gtest.h>

#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/bad_scene.h"

namespace vegard::sim::free_volume_test {
namespace {

class BadFreeVolume : public testing::TestWithParam<Bad> {};

TEST_P(BadFreeVolume, IsRefusedWithLineKeyAndReason) { expect_refused(GetParam()); }

const Bad bad_free_volumes[] = {
    {"width_of_noise", "[[footprint]]\nsource = 'noise'\n[fit]\nfree = ['footprint.width_km']\n", 4,
     "footprint.arc.width_km", "\"noise\" | width_km"},
    {"map_of_a_shell",
     "[[footprint]]\nshape = 'shell'\nlatitude_deg = [60, 61]\nlongitude_deg = [1, 2]\n[fit]\nfree = "
     "['footprint.arc.width_km']\n",
     6, "footprint.arc.width_km", "shell"},
    {"width_of_what_flows",
     "[[footprint]]\nflow_turns = 1\neast_km = [1, 2]\nnorth_km = [1, 2]\n[fit]\nfree = "
     "['footprint.arc.width_km']\n",
     6, "footprint.arc.width_km", "winds | width_km"},
    {"point_of_what_flows",
     "[[footprint]]\nflow_turns = 1\neast_km = [1, 2]\nnorth_km = [1, 2]\n[fit]\nfree = "
     "['footprint.arc.north_km.1']\n",
     6, "footprint.arc.north_km.1", "set flow_turns = 0"},
    {"sheet_that_flows",
     "[[sheet]]\n[[footprint]]\nflow_turns = 1\nsource = 'sheets'\n[fit]\nfree = "
     "['sheet.main.center_km']\n",
     6, "sheet.main.center_km.east", "winds | center_km"},
    {"energy_of_a_footprint_of_given_brightness",
     "[[sheet]]\nbrightness_kilorayleigh = 20\n[[footprint]]\nsource = 'sheets'\n[fit]\nfree = "
     "['sheet.main.energy_kev']\n",
     6, "sheet.main.energy_kev", "brightness is given"},
    {"footprint_of_sheets",
     "[[sheet]]\n[[footprint]]\nsource = 'sheets'\n[fit]\nfree = ['footprint.energy_kev']\n", 5,
     "footprint.arc.energy_kev", "the sheets"},
    {"literal_nebula",
     "[[nebula]]\nmethod = 'literal'\ngas = 'n'\n[[node]]\nname = 'n'\n[fit]\nfree = "
     "['nebula.elevation_deg']\n",
     7, "nebula.nebula.elevation_deg", "colours, not light"},
    {"dust_of_none",
     "[[nebula]]\nglow = 'n'\nglow_rayleigh = [1, 1, 1]\n[[node]]\nname = 'n'\n[fit]\nfree = "
     "['nebula.dust_depth']\n",
     7, "nebula.nebula.dust_depth", "has no dust"},
    {"gas_of_none",
     "[[nebula]]\nglow = 'n'\nglow_rayleigh = [1, 1, 1]\n[[node]]\nname = 'n'\n[fit]\nfree = "
     "['nebula.inner_radius']\n",
     7, "nebula.nebula.inner_radius", "has no gas"},
    {"waist_of_a_sphere",
     "[[nebula]]\nglow = 'n'\nglow_rayleigh = [1, 1, 1]\n[[node]]\nname = 'n'\n[fit]\nfree = "
     "['node.n.waist']\n",
     7, "node.n.waist", "\"sphere\" | waist"},
    {"albedo_without_a_lamp",
     "[[volume]]\nfile = 'a.vdb'\nextinction_per_km = 0.1\n[fit]\nfree = ['volume.volume.albedo']\n", 5,
     "volume.volume.albedo", "no lamp"},
    {"asymmetry_of_what_does_not_scatter",
     "[[volume]]\nfile = 'a.vdb'\nextinction_per_km = 0.1\nlamp_kind = 'direction'\nlamp_flux = [1, 1, "
     "1]\n[fit]\nfree = ['volume.volume.asymmetry']\n",
     7, "volume.volume.asymmetry", "scatters nothing"},
    {"place_against_a_point",
     "[[volume]]\nfile = 'a.vdb'\nextinction_per_km = 0.1\nalbedo = 0.5\nlamp_kind = 'point'\nlamp_flux = "
     "[1, 1, "
     "1]\n[fit]\nfree = ['volume.volume.shift_km']\n",
     8, "volume.volume.shift_km.east", "its lamp"},
    {"node_of_no_nebula", "[[node]]\nname = 'n'\n[fit]\nfree = ['node.n.radius']\n", 4, "node.n.radius",
     "no nebula"},
};

INSTANTIATE_TEST_SUITE_P(Scenes, BadFreeVolume, testing::ValuesIn(bad_free_volumes),
                         [](const testing::TestParamInfo<Bad>& bad) { return std::string(bad.param.what); });

TEST(FreeVolumes, MayBeFreeWhereTheLightDependsOnThem) {
  const Scene scene = parse_scene(R"(
[[footprint]]
east_km = [-100, 0, 100]
north_km = [0, 10, 0]
point_flux = [1, 1, 1]
[[nebula]]
glow = "hull"
glow_rayleigh = [1, 2, 3]
dust = "lane"
dust_depth = 1
[[node]]
name = "hull"
kind = "union"
of = "ball, ring"
[[node]]
name = "ball"
[[node]]
name = "ring"
kind = "torus"
[[node]]
name = "lane"
kind = "slab"
[fit]
free = ["footprint.arc.north_km", "footprint.arc.center_km", "footprint.arc.point_flux.1", "footprint.width_km",
  "nebula.glow_rayleigh", "nebula.dust_exponent", "node.hull.blend", "node.ball.radius", "node.ring.thickness",
  "node.lane.angles_deg"]
)",
                                  "volumes.toml");
  EXPECT_EQ(scene.fit.free.size(), 10u);
}

TEST(FreeVolumes, OfACurtainAndOfWhatFlowsMayBeFree) {
  const Scene scene = parse_scene(R"(
[[sheet]]
[[footprint]]
name = "wall"
model = "curtain"
east_km = [-100, 0, 100]
north_km = [0, 10, 0]
[[footprint]]
name = "curl"
flow_turns = 1
east_km = [-100, 100]
north_km = [0, 10]
point_energy = [1, 2]
[[footprint]]
name = "fold"
flow_turns = 0.5
source = "sheets"
[fit]
free = ["footprint.wall.width_km", "footprint.curl.center_km", "footprint.curl.energy_flux_mw_m2",
  "footprint.curl.point_energy", "sheet.main.energy_kev", "sheet.main.energy_flux_mw_m2"]
)",
                                  "volumes.toml");
  EXPECT_EQ(scene.fit.free.size(), 6u);
}

TEST(FreeVolumes, OfTheSkyAreNotCarriedToAnotherSite) {
  const std::string text = R"(
[site]
latitude_deg = 69
[sun]
shown = true
[fit]
free = ["sun.azimuth_deg"]
[[fit.photo]]
file = "a.png"
[[fit.photo]]
file = "b.png"
set.camera.azimuth_deg = 10
)";
  EXPECT_EQ(parse_scene(text, "volumes.toml").fit.photos.size(), 2u);
  const ErrorDetails details = error_of(text + "set.site.latitude_deg = 68\n");
  EXPECT_NE(details.problem.find("[sun] would be elsewhere"), std::string::npos) << details.problem;
  EXPECT_EQ(details.line, 10);
}

}  // namespace
}  // namespace vegard::sim::free_volume_test
