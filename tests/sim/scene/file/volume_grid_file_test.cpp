// What a volume reads: OpenVDB or volumegrid, the Sun's or the ground's.
#include "sim/scene/file/volume_grid_file.h"

#include <gtest/gtest.h>

#include "sim/base/grid/vdb_io.h"
#include "sim/base/grid/volumegrid_text.h"
#include "tests/support/expect_error.h"
#include "tests/support/kind_named.h"
#include "tests/support/temporary_folder.h"

namespace vegard::volume_grid_file_test {
namespace {

using namespace sim;

SparseGrid one_brick(const std::string& name) {
  SparseGrid grid;
  grid.voxel = 2.0;
  grid.origin = {10.0, 20.0, 700.0};
  grid.channels = {{name, ""}};
  for (float& x : grid.brick({0, 0, 0})) x = 3.0f;
  return grid;
}

Scene scene_in(const tests::TemporaryFolder& folder, const std::string& file, const std::string& frame) {
  Scene scene;
  scene.file = folder / "scene.toml";
  scene.emission.lines = {17.1, 557.7};
  scene.sun.shown = true;
  Volume volume;
  volume.file = file;
  volume.frame = tests::kind_named<VolumeFrame>(frame);
  scene.volumes = {volume};
  return scene;
}

VdbMetadata of_sun(double unit_km) {
  VdbMetadata metadata;
  metadata.texts["frame"] = "sun";
  metadata.numbers["unit_km"] = unit_km;
  metadata.numbers["unit_cm"] = 1e5 * unit_km;
  return metadata;
}

TEST(VolumeGridFile, TheSunsIsReadInTheScenesUnit) {
  const tests::TemporaryFolder folder;
  write_vdb(folder / "a.vdb", one_brick("emission_171"), of_sun(500.0), {});
  const Scene scene = scene_in(folder, "a.vdb", "sun");
  ASSERT_EQ(emission_grid_name(17.1), "emission_171");
  const VolumeGridFile file = read_volume_grid(scene, scene.volumes[0]);
  EXPECT_EQ(file.emission, (std::vector<int>{0, -1}));
  EXPECT_EQ(file.grid.voxel, 1.0);  // of 500 km in a scene whose unit is 1000 km
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(file.grid.origin[c], 0.5 * one_brick("").origin[c], 1e-12);
}

TEST(VolumeGridFile, OneFramesFileIsNotTakenForTheOthers) {
  const tests::TemporaryFolder folder;
  write_vdb(folder / "sun.vdb", one_brick("density"), of_sun(1000.0), {});
  VdbMetadata of_site;
  of_site.texts["frame"] = "x east, y north, z up, in km, the observer at the origin";
  of_site.numbers["site_latitude_deg"] = 60.0;
  write_vdb(folder / "site.vdb", one_brick("density"), of_site, {});
  write_vdb(folder / "foreign.vdb", one_brick("density"), {}, {});
  const auto read = [&](const char* file, const char* frame) {
    const Scene scene = scene_in(folder, file, frame);
    return read_volume_grid(scene, scene.volumes[0]);
  };
  tests::expect_words(ErrorKind::unreadable_input,
                      {"sun.vdb", "volume.volume.file", "the Sun", "frame = \"sun\""},
                      [&] { read("sun.vdb", "site"); });
  tests::expect_words(ErrorKind::unreadable_input, {"site.vdb", "the ground", "frame = \"site\""},
                      [&] { read("site.vdb", "sun"); });
  for (const char* frame : {"sun", "site"}) EXPECT_EQ(read("foreign.vdb", frame).grid.voxel, 2.0);
  EXPECT_EQ(read("site.vdb", "site").site.latitude_deg, 60.0);
  write_vdb(folder / "broken.vdb", one_brick("density"), of_sun(-1.0), {});
  tests::expect_words(ErrorKind::unreadable_input, {"unit_km", "out of range"},
                      [&] { read("broken.vdb", "sun"); });
}

TEST(VolumeGridFile, DensityShinesWhereTheSceneSaysSo) {
  const tests::TemporaryFolder folder;
  SparseGrid both = one_brick("emission_171");
  both.channels.push_back({"density", ""});
  both.bricks.begin()->second.resize(2 * SparseGrid::kVoxels, 0.25f);
  write_vdb(folder / "both.vdb", std::move(both), {}, {});
  Scene scene = scene_in(folder, "both.vdb", "sun");
  EXPECT_EQ(read_volume_grid(scene, scene.volumes[0]).emission[1], -1);
  scene.volumes[0].density_rayleigh = {1.0, 2.0};
  const VolumeGridFile file = read_volume_grid(scene, scene.volumes[0]);
  ASSERT_EQ(file.grid.channels.size(), 1u);
  EXPECT_EQ(file.emission, (std::vector<int>{0, 0}));
  EXPECT_EQ(file.grid.value(0, 0, 0, 0), 0.25f);

  write_vdb(folder / "light.vdb", one_brick("emission_171"), {}, {});
  scene.volumes[0].file = "light.vdb";
  tests::expect_words(ErrorKind::unreadable_input, {"density_rayleigh", "emission_171", "a grid \"density\""},
                      [&] { read_volume_grid(scene, scene.volumes[0]); });
}

TEST(VolumeGridFile, ReadsAVolumegrid) {
  const tests::TemporaryFolder folder;
  write_volumegrid(folder / "a.volumegrid", one_brick("density"), 0, {});
  for (const char* frame : {"sun", "site"}) {
    Scene scene = scene_in(folder, "a.volumegrid", frame);
    scene.volumes[0].extinction_per_km = 0.1;
    const VolumeGridFile file = read_volume_grid(scene, scene.volumes[0]);
    EXPECT_EQ(file.emission, (std::vector<int>{0, 0}));
    EXPECT_EQ(file.density, 0);
    EXPECT_EQ(file.grid.origin, one_brick("").origin);
    EXPECT_EQ(file.grid.value(0, 7, 7, 7), 3.0f);
  }
  tests::put(folder / "b.pbrt", "Volume \"volumegrid\" \"integer nx\" [0]\n");
  const Scene scene = scene_in(folder, "b.pbrt", "site");
  tests::expect_words(ErrorKind::unreadable_input, {"b.pbrt:1", "volume.volume.file", "'0'"},
                      [&] { read_volume_grid(scene, scene.volumes[0]); });
}

}  // namespace
}  // namespace vegard::volume_grid_file_test
