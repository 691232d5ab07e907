#include "sim/render/emitters/footprint_volumes.h"

#include <gtest/gtest.h>

#include "sim/base/picture/image_io.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/scene/file/named_files.h"
#include "tests/support/expect_error.h"
#include "tests/support/kind_named.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::footprint_pictures_test {
namespace {

using tests::expect_error;
using tests::TemporaryFolder;

Scene scene_in(const TemporaryFolder& folder, const char* source, const char* image) {
  Scene scene;
  scene.file = folder / "scene.toml";
  Footprint f;
  f.name = "oval";
  f.shape = FootprintShape::shell;
  f.source = tests::kind_named<FootprintSource>(source);
  f.image = image;
  scene.footprints = {f};
  return scene;
}

Image even(float r, float g, float b) {
  Image image(3, 2, {"R", "G", "B"});
  for (std::size_t i = 0; i < image.data.size(); i += 3) {
    image.data[i] = r;
    image.data[i + 1] = g;
    image.data[i + 2] = b;
  }
  return image;
}

TEST(FootprintPictures, AreReadBesideTheSceneAndTakenAsTheyStand) {
  const TemporaryFolder folder;
  write_display(folder / "oval.png", even(0.2f, 0.4f, 0.6f), 16, 90, {});
  const Scene scene = scene_in(folder, "image", "oval.png");
  VolumeFiles files;
  files.pictures = read_scene_pictures(scene);
  const FootprintPictures pictures = footprint_pictures(files, scene.footprints[0]);
  ASSERT_NE(pictures.flux, nullptr);
  EXPECT_EQ(pictures.energy, nullptr);
  EXPECT_EQ(pictures.flux->width, 3);
  EXPECT_EQ(pictures.flux->channels(), 1);
  // Not decoded: the mean of the three, to the steps of 16 bits.
  for (const float value : pictures.flux->data) EXPECT_NEAR(value, 0.4, 1e-5);
}

TEST(FootprintPictures, OfACubeAreSix) {
  const TemporaryFolder folder;
  const char* const names[6] = {"px", "nx", "py", "ny", "pz", "nz"};
  for (int face = 0; face < 6; ++face)
    write_display(folder / (std::string("foot_") + names[face] + ".png"),
                  even(0.1f * face, 0.1f * face, 0.1f * face), 16, 90, {});
  const Scene scene = scene_in(folder, "cube", "foot_{face}.png");
  VolumeFiles files;
  files.pictures = read_scene_pictures(scene);
  const FootprintPictures pictures = footprint_pictures(files, scene.footprints[0]);
  EXPECT_EQ(pictures.flux, nullptr);
  for (int face = 0; face < 6; ++face) {
    ASSERT_NE(pictures.face[face], nullptr);
    EXPECT_NEAR(pictures.face[face]->data[0], 0.1 * face, 1e-5);
  }
}

TEST(FootprintPictures, ThatAreMissingAreToldByTheirKey) {
  const TemporaryFolder folder;
  std::string text = expect_error(ErrorKind::unreadable_input,
                                  [&] { read_scene_pictures(scene_in(folder, "image", "none.png")); });
  EXPECT_NE(text.find("footprint.oval.image"), std::string::npos) << text;
  EXPECT_NE(text.find("none.png"), std::string::npos) << text;
  write_display(folder / "there.png", even(1, 1, 1), 8, 90, {});
  Scene scene = scene_in(folder, "image", "there.png");
  scene.footprints[0].energy_image = "gone.png";
  text = expect_error(ErrorKind::unreadable_input, [&] { read_scene_pictures(scene); });
  EXPECT_NE(text.find("footprint.oval.energy_image"), std::string::npos) << text;
  scene.footprints[0].source = FootprintSource::spline;  // which reads no files
  EXPECT_NO_THROW(read_scene_pictures(scene));
}

TEST(ScenePictures, HaveABiasMapByItsName) {
  const TemporaryFolder folder;
  write_display(folder / "map.png", even(0.2f, 0.2f, 0.2f), 16, 90, {});
  Scene scene;
  scene.file = folder / "scene.toml";
  scene.chromospheres.resize(1);
  scene.chromospheres[0].name = "clouds";
  VolumeFiles files;
  files.pictures = read_scene_pictures(scene);
  EXPECT_EQ(bias_map(files, scene.chromospheres[0]), nullptr);
  scene.chromospheres[0].biasmap = "map.png";
  files.pictures = read_scene_pictures(scene);
  ASSERT_NE(bias_map(files, scene.chromospheres[0]), nullptr);
  EXPECT_NEAR(bias_map(files, scene.chromospheres[0])->data[3], 0.2, 1e-5);
  scene.chromospheres[0].biasmap = "none.png";
  const std::string text = expect_error(ErrorKind::unreadable_input, [&] { read_scene_pictures(scene); });
  EXPECT_NE(text.find("chromosphere.clouds.biasmap"), std::string::npos) << text;
}

}  // namespace
}  // namespace vegard::sim::footprint_pictures_test
