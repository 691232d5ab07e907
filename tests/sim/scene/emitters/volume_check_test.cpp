#include <string>

#include <gtest/gtest.h>

#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/bad_scene.h"

namespace vegard::sim::volume_check_test {
namespace {

class BadVolume : public testing::TestWithParam<Bad> {};

TEST_P(BadVolume, IsRefusedWithLineKeyAndReason) { expect_refused(GetParam()); }

const Bad bad_volumes[] = {
    {"lamp_without_flux", "[[volume]]\nfile = 'a.vdb'\nlamp_kind = 'direction'\n", 1,
     "volume.volume.lamp_flux", "0 numbers | 3 emission lines"},
    {"lamp_of_a_sun_that_is_not_there", "[[volume]]\nfile = 'a.vdb'\nlamp_kind = 'sun'\n", 3,
     "volume.volume.lamp_kind", "the Sun"},
    {"lamp_of_a_dark_sun", "[sun]\nshown = true\n[[volume]]\nfile = 'a.vdb'\nlamp_kind = 'sun'\n", 5,
     "volume.volume.lamp_kind", "Sun | dark"},
    {"no_points", "[[footprint]]\n", 1, "footprint.arc.east_km", "0 points"},
    {"one_point", "[[footprint]]\neast_km = [1]\nnorth_km = [1]\n", 2, "footprint.arc.east_km",
     "2 to 1000 points"},
    {"uneven_points", "[[footprint]]\neast_km = [1, 2]\nnorth_km = [1]\n", 3, "footprint.arc.north_km",
     "1 of north_km | as many"},
    {"points_of_a_shell", "[[footprint]]\nshape = 'shell'\neast_km = [1, 2]\nnorth_km = [1, 2]\n", 1,
     "footprint.arc.longitude_deg", "0 points"},
    {"flux_of_too_few_points", "[[footprint]]\neast_km = [1, 2]\nnorth_km = [1, 2]\npoint_flux = [1]\n", 4,
     "footprint.arc.point_flux", "1 numbers for 2 points"},
    {"energy_of_no_spline", "[[footprint]]\nsource = 'noise'\npoint_energy = [1]\n", 3,
     "footprint.arc.point_energy", "for 0 points"},
    {"curtain_of_noise", "[[footprint]]\nsource = 'noise'\nmodel = 'curtain'\n", 3, "footprint.arc.model",
     "curtain | spline"},
    {"no_picture", "[[footprint]]\nsource = 'image'\n", 2, "footprint.arc.source", "image names none"},
    {"cube_without_face", "[[footprint]]\nshape = 'shell'\nsource = 'cube'\nimage = 'a.png'\n", 4,
     "footprint.arc.image", "foot_{face}.png"},
    {"cube_of_a_box", "[[footprint]]\nsource = 'cube'\nimage = 'a_{face}.png'\n", 2, "footprint.arc.source",
     "box | cube faces"},
    {"sheets_of_a_shell", "[[sheet]]\n[[footprint]]\nshape = 'shell'\nsource = 'sheets'\n", 4,
     "footprint.arc.source", "is a box's"},
    {"noise_on_one_point",
     "[[footprint]]\nshape = 'shell'\nsource = 'noise'\nlongitude_deg = [1]\nlatitude_deg = [60]\n", 4,
     "footprint.arc.longitude_deg", "1 points"},
    {"noise_along_latitudes_alone",
     "[[footprint]]\nshape = 'shell'\nsource = 'noise'\nlatitude_deg = [70, 71, 72]\n", 4,
     "footprint.arc.latitude_deg", "0 of longitude_deg for 3 of latitude_deg"},
    {"sheets_without_a_sheet", "[[footprint]]\nsource = 'sheets'\n", 2, "footprint.arc.source", "the sheets"},
    {"bulge_of_a_box", "[[footprint]]\neast_km = [1, 2]\nnorth_km = [1, 2]\nbulge_km = 100\n", 4,
     "footprint.arc.bulge_km", "around the Earth"},
    {"bulge_of_a_picture",
     "[[footprint]]\nshape = 'shell'\nsource = 'image'\nimage = 'a.png'\nbulge_km = 100\n", 5,
     "footprint.arc.bulge_km", "a spline"},
    {"bulge_that_stands_still",
     "[[footprint]]\nshape = 'shell'\nlongitude_deg = [1, 2]\nlatitude_deg = [1, 2]\nbulge_km = 100\n"
     "bulge_speed_km_s = 0\n",
     6, "footprint.arc.bulge_speed_km_s", "stands still"},
    {"drift_of_sheets", "[[sheet]]\n[[footprint]]\nsource = 'sheets'\ndrift_km_s = [1, 0]\n", 4,
     "footprint.arc.drift_km_s", "where they go"},
    {"shell_to_the_north",
     "[[footprint]]\nshape = 'shell'\nlongitude_deg = [1, 2]\nlatitude_deg = [1, 2]\ndrift_km_s = [0, 1]\n",
     5, "footprint.arc.drift_km_s", "Earth's axis"},
    {"field_without_a_time", "[field]\nmodel = 'igrf'\n", 2, "field.model", "no time"},
    {"field_of_the_future", "[site]\ntime_utc = '2030-01-01T00:00:00Z'\n[field]\nmodel = 'igrf'\n", 4,
     "field.model", "2030"},
    {"field_of_the_past", "[site]\ntime_utc = '1899-12-31T23:00:00Z'\n[field]\nmodel = 'igrf'\n", 4,
     "field.model", "from 1900 to 2029"},
    {"too_many_cells", "[[footprint]]\nsource = 'noise'\ncell_km = 0.05\n", 3, "footprint.arc.cell_km",
     "more than 67108864 cells"},
    {"too_many_cells_along_a_side", "[[footprint]]\nsource = 'noise'\nsize_km = [6000, 1]\ncell_km = 0.01\n",
     4, "footprint.arc.cell_km", "600000 cells | at most 262000"},
    {"shell_of_too_much_memory",
     "[[footprint]]\nshape = 'shell'\nlongitude_deg = [1, 2]\nlatitude_deg = [1, 2]\n"
     "point_energy = [1, 2]\nface_cells = 8192\n",
     6, "footprint.arc.face_cells", "6.4 GB | 16 bytes | at most 4 GB"},
    {"points_on_opposite_sides",
     "[[footprint]]\nshape = 'shell'\nlatitude_deg = [10, 0, -10]\nlongitude_deg = [0, 80, 260]\n", 4,
     "footprint.arc.longitude_deg", "points 1 and 2 | 170 degrees | 90 degrees"},
    {"points_that_close_too_far_apart",
     "[[footprint]]\nshape = 'shell'\nclosed = true\nlatitude_deg = [0, 0, 0]\n"
     "longitude_deg = [0, 80, 160]\n",
     5, "footprint.arc.longitude_deg", "points 2 and 0 | 160 degrees"},
    {"too_many_pieces",
     "[[footprint]]\nsize_km = [10, 10]\ncell_km = 0.01\nwidth_km = 0.01\n"
     "east_km = [-6000, 6000]\nnorth_km = [0, 0]\n",
     5, "footprint.arc.east_km", "0.008 km | at most 1048576"},
    {"spline_of_too_many_pieces_with_its_bulge",
     "[[footprint]]\nshape = 'shell'\nface_cells = 8192\nwidth_km = 1\nbulge_km = 100\nbulge_length_km = 10\n"
     "latitude_deg = [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]\n"
     "longitude_deg = [0, 80, 0, 80, 0, 80, 0, 80, 0, 80, 0, 80, 0, 80, 0, 80, 0, 80, 0, 80]\n",
     8, "footprint.arc.longitude_deg", "at most 1048576"},
    {"colours_upside_down", "[[footprint]]\nsource = 'noise'\nlow_km = 300\n", 3, "footprint.arc.low_km",
     "low_km below high_km"},
    {"two_of_a_name", "[[footprint]]\nsource = 'noise'\n[[footprint]]\nsource = 'noise'\n", 3, "footprint",
     "[[footprint]] | 'arc' | line 1"},
    {"nebula_of_nothing", "[[nebula]]\n", 1, "nebula.nebula.gas", "made of nothing"},
    {"nebula_of_an_unknown_node", "[[nebula]]\ngas = 'ball'\n", 2, "nebula.nebula.gas", "no node 'ball'"},
    {"literal_without_map", "[[nebula]]\nmethod = 'literal'\ndust = 'n'\n[[node]]\nname = 'n'\n", 1,
     "nebula.nebula.gas", "has no map"},
    {"light_of_too_few_lines", "[[nebula]]\ngas = 'n'\ninner_rayleigh = [1]\n[[node]]\nname = 'n'\n", 3,
     "nebula.nebula.inner_rayleigh", "1 numbers | 3 emission lines"},
    {"radii_upside_down",
     "[[nebula]]\nglow = 'n'\nglow_rayleigh = [1, 1, 1]\ninner_radius = 9\n[[node]]\nname = 'n'\n", 4,
     "nebula.nebula.inner_radius", "inner_radius below outer_radius"},
    {"node_of_an_unknown_kind", "[[node]]\nkind = 'spher'\n", 2, "node.node.kind",
     "did you mean \"sphere\"?"},
    {"sphere_of_something", "[[node]]\nof = 'a'\n", 2, "node.node.of", "not on 1"},
    {"union_of_one", "[[node]]\nname = 'a'\n[[node]]\nkind = 'union'\nof = 'a'\n", 5, "node.node.of",
     "two nodes | not on 1"},
    {"turbulence_of_nothing", "[[node]]\nkind = 'turbulence'\n", 1, "node.node.of", "one node | not on 0"},
    {"node_of_an_unknown_node", "[[node]]\nkind = 'move'\nof = 'b'\n", 3, "node.node.of", "no node 'b'"},
    {"empty_name_in_a_list", "[[node]]\nname = 'a'\n[[node]]\nkind = 'union'\nof = 'a, '\n", 5,
     "node.node.of", "no node ''"},
    {"node_of_itself", "[[node]]\nkind = 'move'\nof = 'node'\n", 3, "node.node.of", "works on itself"},
    {"nodes_in_a_circle",
     "[[node]]\nname = 'a'\nkind = 'move'\nof = 'b'\n[[node]]\nname = 'b'\nkind = 'move'\nof = 'a'\n", 4,
     "node.a.of", "itself"},
    {"too_many_steps", "[[nebula]]\ndust = 'n'\nbound = 1000\nstep = 1e-4\n[[node]]\nname = 'n'\n", 4,
     "nebula.nebula.step", "20000000 steps"},
    {"volume_without_file", "[[volume]]\n", 1, "volume.volume.file", "names no file"},
    {"name_of_a_key", "[[volume]]\nname = 'gain'\nfile = 'a.vdb'\n", 2, "volume.volume.name", "[[node]]"},
};

INSTANTIATE_TEST_SUITE_P(Input, BadVolume, testing::ValuesIn(bad_volumes),
                         [](const auto& info) { return std::string(info.param.what); });

constexpr const char* kEverything = R"(
[[footprint]]
name = "oval"
shape = "shell"
latitude_deg = [65, 70, 66]
longitude_deg = [0, 120, 240]
closed = true
point_energy = [1, 2, 1]
[[footprint]]
east_km = [-100, 100]
north_km = [3, 5]
[[nebula]]
name = "ball"
gas = "round"
inner_rayleigh = [1, 2, 3]
outer_rayleigh = [4, 5, 6]
[[node]]
name = "round"
radius = 0.7
[[node]]
name = "rough"
kind = "turbulence"
of = "round"
[[volume]]
file = "a.vdb"
[march]
step_km = 3
)";

/// So many unions, each of the one before with itself.
std::string doubled_nodes(int unions) {
  std::string text = "[[node]]\nname = 'n0'\n";
  for (int n = 1; n <= unions; ++n) {
    const std::string before = "n" + std::to_string(n - 1);
    text += "[[node]]\nname = 'n" + std::to_string(n) + "'\nkind = 'union'\nof = '" + before + ", " + before +
            "'\n";
  }
  return text;
}

TEST(VolumeScene, NodesThatShareWhatTheyWorkOnAreCountedEachTime) {
  EXPECT_NO_THROW(parse_scene(doubled_nodes(12), "a.toml"));  // 8191 looks at a point
  const ErrorDetails details = error_of(doubled_nodes(25));
  EXPECT_EQ(details.key, "node.n13.of");
  EXPECT_NE(details.problem.find("16383 nodes"), std::string::npos) << details.problem;
}

TEST(VolumeScene, ThereIsAnEndToTheNumberOfNodes) {
  std::string text;
  for (int n = 0; n < 1001; ++n) text += "[[node]]\nname = 'n" + std::to_string(n) + "'\n";
  EXPECT_EQ(error_of(text).problem, "1001 nodes");
}

TEST(VolumeScene, ReadsBackAsItWasWritten) {
  const Scene scene = parse_scene(kEverything, "a.toml");
  const std::string written = write_scene(scene);
  EXPECT_EQ(write_scene(parse_scene(written, "b.toml")), written);
  EXPECT_EQ(scene.footprints.size(), 2u);
  EXPECT_EQ(scene.footprints[0].point_energy, (std::vector<double>{1, 2, 1}));
  EXPECT_EQ(scene.nodes[1].of, "round");
  EXPECT_EQ(scene.march.step_km, 3.0);
}

TEST(VolumeScene, MayBeAsFineAsMemoryAllows) {
  const char* const text =
      "[[footprint]]\nshape = 'shell'\nface_cells = 4096\npoint_energy = [1, 2]\n"
      "latitude_deg = [65, 65]\nlongitude_deg = [0, 100]\n"
      "[[footprint]]\nname = 'strip'\nsource = 'noise'\nsize_km = [2600, 1]\ncell_km = 0.01\n";
  EXPECT_EQ(parse_scene(text, "a.toml").footprints.size(), 2u);
}

TEST(VolumeScene, PathsReachElementsByNameAndTheOnlyOneWithout) {
  Scene scene = parse_scene(kEverything, "a.toml");
  set_from_text(scene, "footprint.arc.north_km.1", "7");
  EXPECT_EQ(scene.footprints[1].north_km[1], 7.0);
  set_from_text(scene, "nebula.inner_rayleigh.5577", "9");
  EXPECT_EQ(scene.nebulae[0].inner_rayleigh[1], 9.0);
  set_from_text(scene, "node.round.center", "[1, 2, 3]");
  EXPECT_EQ(scene.nodes[0].center[2], 3.0);
  const std::vector<ParameterPath> paths = resolve(scene, "footprint.oval.longitude_deg");
  ASSERT_EQ(paths.size(), 3u);
  EXPECT_EQ(paths[0].element, 0);
  EXPECT_EQ(paths[0].sheet(), -1);
}

}  // namespace
}  // namespace vegard::sim::volume_check_test
