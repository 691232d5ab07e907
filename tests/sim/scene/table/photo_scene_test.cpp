// [[fit.photo]]: in and out of a scene file, and the scene as each photograph has it.
#include "sim/scene/table/photo_scene.h"

#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::photo_scene_test {
namespace {

const char* const kTwoStations = R"(
[site]
latitude_deg = 69.0
longitude_deg = 19.0
[camera]
azimuth_deg = 10.0
[[sheet]]
center_km = [0.0, 150.0]
[fit]
bands = 4
free = ["sheet.main.energy_kev"]
[[fit.photo]]
file = "pictures/home.png"
[[fit.photo]]
name = "south"
file = "pictures/far.tif"
mask = "sky.png"
decoding = "linear"
set.site.latitude_deg = 68.1
set.camera.azimuth_deg = 350
set."fit.roi_px" = [10, 20, 100, 80]
set.blur.width_deg = [0.2]
set.emission.lines = [557.7]
)";

TEST(Photographs, ComeFromAFileWithWhatEachAloneHas) {
  const Scene scene = parse_scene(kTwoStations, "scene.toml");
  ASSERT_EQ(scene.fit.photos.size(), 2u);
  EXPECT_EQ(scene.fit.photos[0].name, "home") << "the file's name without its ending";
  const PhotoEntry& south = scene.fit.photos[1];
  EXPECT_EQ(south.file, "pictures/far.tif");
  EXPECT_EQ(south.mask, "sky.png");
  EXPECT_EQ(south.decoding, "linear");
  ASSERT_EQ(south.set.size(), 5u);
  EXPECT_EQ(south.set[0], (std::pair<std::string, std::string>{"site.latitude_deg", "68.1"}));
  EXPECT_EQ(south.set[1], (std::pair<std::string, std::string>{"camera.azimuth_deg", "350"}));
  EXPECT_EQ(south.set[2], (std::pair<std::string, std::string>{"fit.roi_px", "[10, 20, 100, 80]"}));
}

TEST(Photographs, AreWrittenAsTheyWereRead) {
  const Scene scene = parse_scene(kTwoStations, "scene.toml");
  const Scene again = parse_scene(write_scene(scene), "again.toml");
  ASSERT_EQ(again.fit.photos.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const PhotoEntry &a = scene.fit.photos[i], &b = again.fit.photos[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.file, b.file);
    EXPECT_EQ(a.mask, b.mask);
    EXPECT_EQ(a.decoding, b.decoding);
    EXPECT_EQ(a.set, b.set);
  }
  EXPECT_EQ(write_scene(again), write_scene(scene));
}

TEST(Photographs, EachSeesASceneOfItsOwn) {
  const Scene scene = parse_scene(kTwoStations, "scene.toml");
  const Scene home = scene_of_photo(scene, scene.fit.photos[0]);
  EXPECT_EQ(home.camera.azimuth_deg, 10.0);
  EXPECT_EQ(home.sheets[0].center_km.north, 150.0);
  EXPECT_TRUE(home.fit.photos.empty());
  EXPECT_TRUE(home.fit.free.empty()) << "what all share is no matter of one";
  const Scene south = scene_of_photo(scene, *find_photo(scene, "south"));
  EXPECT_EQ(south.camera.azimuth_deg, 350.0);
  EXPECT_EQ(south.fit.roi_px, (std::array<int, 4>{10, 20, 100, 80}));
  EXPECT_EQ(south.emission.lines, std::vector<double>{557.7});
  EXPECT_EQ(south.blur.width_deg, std::vector<double>{0.2});
  // 0.9 degrees of the meridian, at 110 km.
  EXPECT_NEAR(south.sheets[0].center_km.north, 150.0 + 0.9 * 0.017453292519943295 * 6481.0, 0.1);
  EXPECT_EQ(scene_of_photo_in_site_frame(scene, *find_photo(scene, "south")).sheets[0].center_km.north,
            150.0);
}

TEST(Photographs, FreeEntriesOfOneAreItsAlone) {
  Scene scene = parse_scene(kTwoStations, "scene.toml");
  FreeParameter free;
  free.path = "camera.elevation_deg";
  free.photo = "south";
  scene.fit.free.push_back(free);
  validate(scene);
  EXPECT_TRUE(scene_of_photo(scene, scene.fit.photos[0]).fit.free.empty());
  const Scene south = scene_of_photo(scene, scene.fit.photos[1]);
  ASSERT_EQ(south.fit.free.size(), 1u);
  EXPECT_EQ(south.fit.free[0].path, "camera.elevation_deg");
  validate(south);

  scene.fit.free.back().photo = "sooth";
  EXPECT_NE(tests::expect_error(ErrorKind::scene, [&] { validate(scene); }).find("did you mean 'south'?"),
            std::string::npos);
  scene.fit.free.back().photo = "south";
  scene.fit.free.back().max = 5.0;  // below the scene's elevation
  EXPECT_NE(tests::expect_error(ErrorKind::scene, [&] { validate(scene); }).find("photograph 'south'"),
            std::string::npos);
}

TEST(Photographs, WhatAllShareNoneMaySetOrFreeForItself) {
  Scene scene = parse_scene(kTwoStations, "scene.toml");
  FreeParameter free;
  free.path = "camera.azimuth_deg";
  scene.fit.free.push_back(free);
  EXPECT_NE(tests::expect_error(ErrorKind::scene, [&] { validate(scene); }).find("'south'"),
            std::string::npos);
  scene.fit.free.back().photo = "home";
  validate(scene);
  free.path = "sheet.main.energy_kev";
  free.photo = "home";
  scene.fit.free.push_back(free);
  EXPECT_NE(tests::expect_error(ErrorKind::scene, [&] { validate(scene); }).find("free twice"),
            std::string::npos);
}

struct Refusal {
  const char *name, *text;
  int line;
  const char* words;
};

class PhotographRefusals : public testing::TestWithParam<Refusal> {};

TEST_P(PhotographRefusals, NameTheLine) {
  const Refusal& r = GetParam();
  try {
    parse_scene(r.text, "scene.toml");
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.kind()), static_cast<int>(ErrorKind::scene));
    EXPECT_EQ(error.details().line, r.line) << error.what();
    EXPECT_NE(std::string(error.what()).find(r.words), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scene, PhotographRefusals,
    testing::Values(
        Refusal{"no_file", "[fit]\n[[fit.photo]]\nname = \"a\"\n", 2, "the photograph has no file"},
        Refusal{"one_table", "[fit.photo]\nname = \"a\"\n", 1, "write [[fit.photo]]"},
        Refusal{"unknown_key", "[[fit.photo]]\nfile = \"a.png\"\nfille = \"b\"\n", 3, "did you mean 'file'?"},
        Refusal{"number_for_file", "[[fit.photo]]\nfile = 3\n", 2, "found the whole number 3"},
        Refusal{"name_twice", "[[fit.photo]]\nfile = \"a.png\"\n[[fit.photo]]\nfile = \"b/a.png\"\n", 3,
                "two photographs are called 'a', the first in line 1"},
        Refusal{"name_with_slash", "[[fit.photo]]\nfile = \"a.png\"\nname = \"b/a\"\n", 1,
                "cannot be part of a file's name"},
        Refusal{"decoding", "[[fit.photo]]\nfile = \"a.png\"\ndecoding = \"srbg\"\n", 1,
                "did you mean 'srgb'?"},
        Refusal{"set_a_number", "[[fit.photo]]\nfile = \"a.png\"\nset = 3\n", 3, "a table of path = value"},
        Refusal{"unknown_path", "[[fit.photo]]\nfile = \"a.png\"\nset.camera.azimut_deg = 3\n", 1,
                "did you mean 'camera.azimuth_deg'?"},
        Refusal{"value", "[[fit.photo]]\nfile = \"a.png\"\nset.camera.hfov_deg = 300.0\n", 1,
                "photograph 'a': 300 is outside the limits"},
        Refusal{"search_key", "[[fit.photo]]\nfile = \"a.png\"\nset.fit.scan_points = 3\n", 1,
                "no matter of a single photograph"},
        Refusal{"table_file", "[[fit.photo]]\nfile = \"a.png\"\nset.sensor.response = \"own.csv\"\n", 1,
                "a table in a file"},
        Refusal{"region", "[[fit.photo]]\nfile = \"a.png\"\nset.fit.roi_px = [0, 0, 10, 10]\n", 1,
                "photograph 'a': 24 bands do not fit"}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace vegard::sim::photo_scene_test
