// False colour: ends, order, what "none" leaves alone, and bad tables.
#include "sim/view/colour/colour_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/table_files.h"
#include "sim/view/sensor/sensor.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::colour_table_test {
namespace {

using namespace sim;

Image greys() {
  Image image(101, 1, {"R", "G", "B"});
  for (int x = 0; x <= 100; ++x)
    for (int c = 0; c < 3; ++c) image.at(x, 0, c) = 0.01f * static_cast<float>(x);
  return image;
}

Scene with_table(const tests::TemporaryFolder& folder, const std::string& csv) {
  Scene scene;
  scene.file = folder / "scene.toml";
  tests::put(folder / "table.csv", csv);
  scene.sensor.colour_table = "table.csv";
  read_table_files(scene);
  return scene;
}

TEST(ColourTable, RunsFromBlackToWhiteAndNeverFalls) {
  for (const char* name : {"171", "195", "284", "304"}) {
    SCOPED_TRACE(name);
    const ColourTable table = ColourTable::named(name);
    EXPECT_EQ(table.at(0.0), (std::array<double, 3>{0.0, 0.0, 0.0}));
    EXPECT_EQ(table.at(1.0), (std::array<double, 3>{1.0, 1.0, 1.0}));
    EXPECT_EQ(table.at(-1.0), table.at(0.0));
    EXPECT_EQ(table.at(2.0), table.at(1.0));
    EXPECT_EQ(table.at(std::nan("")), table.at(0.0));
    double before = -1.0;
    for (int i = 0; i <= 1000; ++i) {
      const std::array<double, 3> rgb = table.at(0.001 * i);
      const double luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
      EXPECT_GE(luminance, before) << i;
      before = luminance;
    }
  }
}

TEST(ColourTable, The171IsGold) {
  const std::array<double, 3> middle = ColourTable::named("171").at(0.5);
  EXPECT_NEAR(middle[0], 0.5 / 0.69, 1e-6);
  EXPECT_NEAR(middle[1], 0.5, 1e-12);
  EXPECT_EQ(middle[2], 0.0);
}

TEST(ColourTable, NoneLeavesAPictureAlone) {
  Image image = greys();
  image.at(3, 0, 1) = 0.7f;
  const Image before = image;
  ColourTable::named("none").colour(image);
  EXPECT_EQ(image.data, before.data);
  EXPECT_TRUE(ColourTable(Scene()).is_none());
}

TEST(ColourTable, DisplayFilesGoThroughItBehindTheTone) {
  Scene scene;
  scene.sensor.tone = ToneKind::gamma;
  scene.sensor.gamma = 2.0;
  const Image plain = encoded(scene, greys());
  scene.sensor.colour_table = "171";
  const Image shown = encoded(scene, greys());
  const ColourTable table = ColourTable::named("171");
  for (int x = 0; x <= 100; ++x)
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(shown.at(x, 0, c), static_cast<float>(table.at(plain.at(x, 0, 0))[c])) << x;
}

TEST(ColourTable, TakesTheMeanOfTheChannels) {
  Image image(1, 1, {"R", "G", "B"});
  image.data = {0.25f, 0.5f, 0.75f};
  ColourTable::named("304").colour(image);
  for (int c = 0; c < 3; ++c)
    EXPECT_EQ(image.at(0, 0, c), static_cast<float>(ColourTable::named("304").at(0.5)[c]));
}

TEST(ColourTable, PhotographsAreReadWithoutIt) {
  Scene scene;
  scene.sensor.tone = ToneKind::gamma;
  scene.sensor.gamma = 2.0;
  scene.sensor.mosaic = MosaicPattern::none;
  std::vector<Image> read;
  std::vector<std::vector<float>> noise;
  for (const char* table : {"none", "171"}) {
    scene.sensor.colour_table = table;
    read.push_back(greys());
    std::vector<std::uint8_t> usable(read.back().data.size(), 1);
    recover_light(scene, 1.0 / 255.0, read.back(), usable);
    noise.push_back(light_variance(scene, read.back(), 1.0 / 255.0).data);
  }
  EXPECT_EQ(read[0].data, read[1].data);
  EXPECT_EQ(noise[0], noise[1]);
  EXPECT_GT(noise[0][150], 0.0f);
}

TEST(ColourTable, ReadsATable) {
  const tests::TemporaryFolder folder;
  const ColourTable table(with_table(folder, "grey,red,green,blue\n0,0,0,0.5\n0.5,1,0,0.5\n1,1,1,0\n"));
  const std::array<double, 3> quarter = table.at(0.25), high = table.at(0.75);
  EXPECT_EQ(quarter, (std::array<double, 3>{0.5, 0.0, 0.5}));
  EXPECT_EQ(high, (std::array<double, 3>{1.0, 0.5, 0.25}));
}

TEST(ColourTable, RefusesBadTablesByLine) {
  const tests::TemporaryFolder folder;
  const struct {
    const char* csv;
    std::vector<std::string> words;
  } cases[] = {
      {"grey,red,green\n0,0,0\n1,1,1\n", {"blue"}},
      {"grey,red,green,blue\n0,0,0,0\n1,1,1.5,1\n", {":3", "green", "from 0 to 1"}},
      {"grey,red,green,blue\n0,0,0,0\n0.5,0,0,0\n0.5,0,0,0\n1,1,1,1\n", {":4", "grey"}},
      {"grey,red,green,blue\n0.1,0,0,0\n1,1,1,1\n", {":2", "begins above black", "sensor.colour_table"}},
      {"grey,red,green,blue\n0,0,0,0\n0.9,1,1,1\n", {":3", "ends below white"}},
      {"grey,red,green,blue\n0,0,0,none\n", {":2", "none"}},
  };
  for (const auto& one : cases) {
    std::vector<std::string> words = one.words;
    words.push_back("table.csv");
    tests::expect_words(ErrorKind::unreadable_input, words,
                        [&] { ColourTable table(with_table(folder, one.csv)); });
  }
}

TEST(ColourTable, RefusesUnknownNames) {
  const tests::TemporaryFolder folder;
  tests::put(folder / "a.toml", "seed = 1\n[sensor]\ncolour_table = \"172\"\n");
  tests::expect_words(ErrorKind::scene, {"a.toml:3", "sensor.colour_table", "\"172\"", "\"304\"", "FILE.csv"},
                      [&] { read_scene(folder / "a.toml"); });
  tests::put(folder / "b.toml", "seed = 1\n[sensor]\ncolour_table = \"nome\"\n");
  tests::expect_words(ErrorKind::scene, {"did you mean \"none\"?"}, [&] { read_scene(folder / "b.toml"); });
}

}  // namespace
}  // namespace vegard::colour_table_test
