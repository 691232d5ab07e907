#include "sim/render/emitters/volume_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/base/picture/image_io.h"
#include "sim/view/camera/camera.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::depth_file_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Scene scene_in(const tests::TemporaryFolder& folder, const std::string& name) {
  Scene scene;
  scene.file = folder / "scene.toml";
  scene.camera.width = 4;
  scene.camera.height = 2;
  scene.camera.elevation_deg = 30.0;
  scene.march.depth = name;
  return scene;
}

Image depths(std::vector<std::string> names) {
  Image image(4, 2, std::move(names));
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<float>(i + 1);
  return image;
}

TEST(ReadDepth, TakesTheZOfAnExr) {
  const tests::TemporaryFolder folder;
  Image image = depths({"R", "G", "B", "view.Depth.Z"});
  image.data[3] = kInfinity;
  write_exr(folder / "z.exr", image, {});
  const DepthImage depth = read_depth(scene_in(folder, "z.exr"));
  EXPECT_EQ(depth.end_km(0.5, 0.5, 1.0), kInfinity);
  EXPECT_EQ(depth.end_km(1.5, 0.5, 1.0), 8.0);
  EXPECT_EQ(depth.end_km(3.5, 1.5, 1.0), 32.0);
}

TEST(ReadDepth, TakesTheOnlyChannelWhateverItIsCalled) {
  const tests::TemporaryFolder folder;
  write_exr(folder / "v.exr", depths({"V"}), {});
  EXPECT_EQ(read_depth(scene_in(folder, "v.exr")).end_km(2.5, 1.5, 1.0), 7.0);
}

TEST(ReadDepth, TakesAPngOf16BitsWithoutACurve) {
  const tests::TemporaryFolder folder;
  Image image(4, 2, {"Y"});
  for (int i = 0; i < 8; ++i) image.data[i] = static_cast<float>(1000.0 * i / 65535.0);
  write_display(folder / "d.png", image, 16, 100, {});
  Scene scene = scene_in(folder, "d.png");
  scene.march.depth_gain = 65.535;
  // Sixteen bits hold these numbers exactly; a float rounds them to 6e-8.
  EXPECT_NEAR(read_depth(scene).end_km(3.5, 1.5, 1.0), 7.0, 1e-6);
  EXPECT_NEAR(read_depth(scene).end_km(1.5, 0.5, 1.0), 1.0, 1e-6);
}

TEST(ReadDepth, OfASceneWithoutOneIsEmpty) { EXPECT_TRUE(read_depth(Scene()).empty()); }

TEST(ReadDepth, SaysWhatIsWrongWithAFile) {
  const tests::TemporaryFolder folder;
  const auto refused = [&](const std::string& name, std::vector<std::string> words) {
    words.push_back("march.depth");
    tests::expect_words(ErrorKind::unreadable_input, words, [&] { read_depth(scene_in(folder, name)); });
  };
  refused("none.exr", {"none.exr", "relative to the scene's file"});
  Image image = depths({"Z"});
  image.data[5] = -1.0f;
  write_exr(folder / "negative.exr", image, {});
  refused("negative.exr", {"negative"});
  image.data[5] = std::nanf("");
  write_exr(folder / "nan.exr", image, {});
  refused("nan.exr", {"no number"});
  write_exr(folder / "large.exr", Image(5, 2, {"Z"}), {});
  refused("large.exr", {"5 x 2", "4 x 2"});
}

TEST(RayEnds, AreOfTheNearerOfGroundAndDepth) {
  Scene scene;
  scene.camera.width = 40;
  scene.camera.height = 30;
  scene.camera.hfov_deg = 70.0;
  scene.camera.elevation_deg = -5.0;
  scene.site.altitude_m = 4e5;
  scene.march.depth_is = DepthMeaning::forward;
  Image values(40, 30, {"Z"});
  for (float& value : values.data) value = 900.0f;
  const DepthImage depth = depth_image(scene.march, values);
  FilmGeometry film;
  film.x0_px = -2.0;
  film.y0_px = -2.0;
  film.columns = 44;
  film.rows = 34;
  const std::vector<float> ends = ray_ends_km(scene, film, depth, 2),
                           ground = ray_ends_km(scene, film, {}, 2);
  const CameraView<double> view = camera_view(scene.camera);
  int by_ground = 0, by_depth = 0;
  for (int r = 0; r < film.rows; ++r)
    for (int c = 0; c < film.columns; ++c) {
      // The unnormalised ray of a pinhole: forward component 1.
      const double x = (c - 1.5 - 20.0) / view.lens.focal_px, y = (r - 1.5 - 15.0) / view.lens.focal_px;
      const double along_ray = 900.0 * std::sqrt(1.0 + x * x + y * y);
      const float on_ground = ground[r * film.columns + c], end = ends[r * film.columns + c];
      ASSERT_FLOAT_EQ(end, static_cast<float>(std::min<double>(on_ground, along_ray)));
      ++(end == on_ground ? by_ground : by_depth);
    }
  EXPECT_GT(by_ground, 100) << "where it looks down";
  EXPECT_GT(by_depth, 100);
}

}  // namespace
}  // namespace vegard::sim::depth_file_test
