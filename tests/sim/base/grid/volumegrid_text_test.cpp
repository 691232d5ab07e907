// pbrt's volumegrid text: there and back, what it forgives and what it refuses.
#include "sim/base/grid/volumegrid_text.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/random.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::volumegrid_text_test {
namespace {

using sim::ErrorKind;
using sim::SparseGrid;

constexpr const char* kSmall =
    "Volume \"volumegrid\" \"integer nx\" [3] \"integer ny\" [2] \"integer nz\" [2]\n"
    "\"point p0\" [-3 0 1] \"point p1\" [3 4 5]\n"
    "\"float density\" [ 0 1 2 3 4 5\n 6 7 8 9 10 11 ]\n";

/// Some voxels here and there.
SparseGrid scattered() {
  SparseGrid grid;
  grid.voxel = 0.25;
  grid.origin = {3.0, -2.0, 90.0};
  grid.channels = {{"emission_171", ""}, {"density", ""}};
  for (std::uint32_t n = 0; n < 40; ++n) {
    const auto words = sim::random_words(5, sim::Stream::path, n, 0, 0);
    const int at[3] = {static_cast<int>(words[0] % 37) - 15, static_cast<int>(words[1] % 23) - 11,
                       static_cast<int>(words[2] % 31) - 3};
    auto& brick = grid.brick({at[0] >> 3, at[1] >> 3, at[2] >> 3});
    const int v = SparseGrid::within(at[0] & 7, at[1] & 7, at[2] & 7);
    brick[v] = 1.0f;
    // Of all sizes, and some below 0.
    brick[SparseGrid::kVoxels + v] =
        std::ldexp(static_cast<float>(words[3]) - 2e9f, static_cast<int>(n) - 60);
  }
  return grid;
}

TEST(VolumegridText, CountsXFirstThenYThenZ) {
  const tests::TemporaryFolder folder;
  tests::put(folder / "a.pbrt", kSmall);
  const sim::VolumegridFile file = sim::read_volumegrid(folder / "a.pbrt");
  EXPECT_EQ(file.size, (std::array<int, 3>{3, 2, 2}));
  EXPECT_EQ(file.grid.voxel, 2.0);
  EXPECT_EQ(file.grid.origin, (std::array<double, 3>{-3.0, 0.0, 1.0}));
  ASSERT_EQ(file.grid.channels.size(), 1u);
  EXPECT_EQ(file.grid.channels[0].name, "density");
  for (int z = 0; z < 2; ++z)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x) EXPECT_EQ(file.grid.value(0, x, y, z), x + 3 * (y + 2 * z));
}

TEST(VolumegridText, GivesBackWhatWasWritten) {
  const tests::TemporaryFolder folder;
  const SparseGrid grid = scattered();
  sim::VolumegridOptions options;
  options.colours["Le"] = {1.0, 0.1, 1.0 / 3.0};
  sim::write_volumegrid(folder / "a.volumegrid", grid, 1, options);
  const sim::VolumegridFile back = sim::read_volumegrid(folder / "a.volumegrid");
  EXPECT_EQ(back.colours, options.colours);
  EXPECT_EQ(back.grid.voxel, grid.voxel);
  int shift[3], found = 0;
  for (int a = 0; a < 3; ++a) {
    const double voxels = (back.grid.origin[a] - grid.origin[a]) / grid.voxel;
    shift[a] = static_cast<int>(voxels);
    EXPECT_EQ(voxels, shift[a]);
  }
  for (int x = -20; x < 30; ++x)
    for (int y = -20; y < 20; ++y)
      for (int z = -10; z < 40; ++z) {
        const float number = grid.value(1, x, y, z);
        EXPECT_EQ(back.grid.value(0, x - shift[0], y - shift[1], z - shift[2]), number);
        found += number != 0.0f;
      }
  EXPECT_GT(found, 30);
  // What is read is written again in the same bytes.
  options.size = back.size;
  sim::write_volumegrid(folder / "b.volumegrid", back.grid, 0, options);
  EXPECT_EQ(tests::bytes_of(folder / "b.volumegrid"), tests::bytes_of(folder / "a.volumegrid"));
}

TEST(VolumegridText, KeepsTheEmptyEdgesOfItsBox) {
  const tests::TemporaryFolder folder;
  tests::put(folder / "a.pbrt",
             "Volume \"volumegrid\" \"integer nx\" 3 \"integer ny\" 3 \"integer nz\" 3 \"float density\" "
             "[0 0 0 0 0 0 0 0 0  0 0 0 0 1 0 0 0 0  0 0 0 0 0 0 0 0 0]");
  const sim::VolumegridFile file = sim::read_volumegrid(folder / "a.pbrt");
  EXPECT_NEAR(file.grid.voxel, 1.0 / 3.0, 1e-15);  // pbrt's own box is that of unit length
  sim::VolumegridOptions options;
  sim::write_volumegrid(folder / "tight.pbrt", file.grid, 0, options);
  options.size = file.size;
  sim::write_volumegrid(folder / "wide.pbrt", file.grid, 0, options);
  EXPECT_EQ(sim::read_volumegrid(folder / "tight.pbrt").size, (std::array<int, 3>{1, 1, 1}));
  EXPECT_EQ(sim::read_volumegrid(folder / "wide.pbrt").size, (std::array<int, 3>{3, 3, 3}));
}

TEST(VolumegridText, EmptyBricksAreNone) {
  const tests::TemporaryFolder folder;
  std::string text =
      "Volume \"volumegrid\" \"integer nx\" [32] \"integer ny\" [32] \"integer nz\" [32] \"float density\" [";
  for (int i = 0; i < 32 * 32 * 32; ++i) text += i == 20 * 32 * 32 + 9 * 32 + 30 ? "1e-3 " : "0 ";
  tests::put(folder / "a.pbrt", text + "]");
  const SparseGrid grid = sim::read_volumegrid(folder / "a.pbrt").grid;
  ASSERT_EQ(grid.bricks.size(), 1u);
  EXPECT_EQ(grid.value(0, 30, 9, 20), 1e-3f);
}

TEST(VolumegridText, ForgivesOrderCommentsAndBareValues) {
  const tests::TemporaryFolder folder;
  tests::put(
      folder / "a.pbrt",
      "# of a scene\nLookAt 0 0 5  0 0 0  0 1 0\nAttributeBegin\nVolume \"homogeneous\" \"float g\" 0\n"
      "Volume\n\t\"volumegrid\" \"float density\" [ +1 2e0 # two\n\n 3. .5 ]\"string name\"[\"a # b\"]"
      "\"color sigma_a\" [0 .1 1]\"float g\" .3 \"bool fine\" [\"true\"]\r\n"
      "\"integer nz\"[1]\"integer ny\" 2\"integer  nx\" [2.0] \"point p1\" [2 2 1]\nAttributeEnd\n");
  const sim::VolumegridFile file = sim::read_volumegrid(folder / "a.pbrt");
  EXPECT_EQ(file.size, (std::array<int, 3>{2, 2, 1}));
  EXPECT_EQ(file.grid.value(0, 0, 0, 0), 1.0f);
  EXPECT_EQ(file.grid.value(0, 1, 0, 0), 2.0f);
  EXPECT_EQ(file.grid.value(0, 0, 1, 0), 3.0f);
  EXPECT_EQ(file.grid.value(0, 1, 1, 0), 0.5f);
  EXPECT_EQ(file.colours.at("sigma_a"), (std::array<double, 3>{0.0, 0.1, 1.0}));
}

TEST(VolumegridText, SaysWhatIsWrongAndWhere) {
  const tests::TemporaryFolder folder;
  const std::string head =
      "Volume \"volumegrid\"\n\"integer nx\" [2]\n\"integer ny\" [2]\n\"integer nz\" [1]\n";
  const std::string cubes = "\"point p1\" [2 2 1]\n";
  const struct {
    std::string text;
    std::vector<std::string> words;
  } cases[] = {
      {"", {"has no volumegrid"}},
      {"WorldBegin\nVolume \"exponential\"", {"has no volumegrid"}},
      {head + cubes + "\"float density\" [1 2\n3]", {":7:", "3 densities", "4 of them", "2 x 2 x 1"}},
      {head + cubes + "\"float density\" [1 2 3 4\n5]", {":7:", "too many", "4 of them"}},
      {head + cubes + "\"float density\" [1 2\n3", {"cut off", "after 3 densities", "4 of them"}},
      {head + cubes + "\"float density\"", {"ends before the value", "density"}},
      {head + cubes + "\"float density\" [1 2\nx 4]", {":7:", "'x' is no number"}},
      {head + cubes + "\"float density\" [1 2 nan 4]", {":6:", "'nan' is no number"}},
      {head + cubes + "\"float density\" [1 2 1e999 4]", {"'1e999' is no number"}},
      {head + cubes + "\"float density\" [1 2 1e31 4]", {"too large", "1e30"}},
      {head + cubes + "\"float density\" [1 2 \"3\" 4]", {"\"3\" is no number"}},
      {head + cubes + "\"float density\" [1 2 [ 4]", {"a [ within a list"}},
      {head + cubes + "\"float density\" ]", {"a ] without its ["}},
      {head + cubes, {"there are 0 densities", "4 of them"}},
      {head + "\"float density\" [1 2 3 4]", {"no cubes", "0.5 x 0.5 x 1"}},
      {head + "\"point p1\" [2 2]", {"\"p1\" of line 5 has 2 numbers", "three"}},
      {head + "\"point p0\" [3 0 0] \"point p1\" [2 2 1] \"float density\" [1 2 3 4]",
       {"p1 is not above p0"}},
      {"Volume \"volumegrid\" \"integer ny\" 2 \"integer nz\" 2 \"float density\" [1]",
       {"no \"integer nx\""}},
      {"Volume \"volumegrid\"\n\"integer nx\" [-3]", {":2:", "'-3'", "from 1 to 65536"}},
      {"Volume \"volumegrid\" \"integer nx\" [100000]", {"'100000'", "from 1 to 65536"}},
      {"Volume \"volumegrid\" \"integer nx\" [2.5]", {"'2.5'"}},
      {"Volume \"volumegrid\" \"integer nx\" [2 3]", {"'3'", "one whole number"}},
      {"Volume \"volumegrid\" \"integer nx\" []", {"has no value"}},
      {"Volume \"volumegrid\" \"nx\" [2]", {"\"nx\" is no parameter", "\"integer nx\""}},
      {"Volume \"volumegrid\" \"integer\nnx\" 2", {"not closed in its line"}},
      {head + cubes + "\"float density\" [1 2 3 4]\nVolume \"volumegrid\"", {":7:", "second volumegrid"}},
      {head + cubes + "\"float density\" [1 2 3 4] \"float density\" [1]", {"given twice"}},
      {head + "\"integer ny\" [2]", {":5:", "\"ny\" is given twice"}},
      {head + cubes + "\"point p1\" [2 2 1]", {":6:", "\"p1\" is given twice"}},
      {head + "\"point p0\" [0 0 0]\n\"point p0\" [0 0 0]", {":6:", "\"p0\" is given twice"}},
      {head + "\"point p0\"\n[-1e308 0 0]", {"\"p0\" of line 5 is at -1e+308", "1e12"}},
      {head + "\"point p1\" [1 1.1e12 1]\n", {"\"p1\" of line 5 is at 1.1e+12", "1e12"}},
      {head + "\"point p1\" [4e9 4e9 2e9] \"float density\" [1 2 3 4]", {"2e+09 wide", "1e-9 to 1e9"}},
      {head + "\"point p1\" [4e-10 4e-10 2e-10] \"float density\" [1 2 3 4]", {"2e-10 wide"}},
      {std::string(5000, 'x'), {"more than 256 letters"}},
  };
  for (const auto& one : cases) {
    SCOPED_TRACE(one.text.substr(0, 200));
    tests::put(folder / "a.pbrt", one.text);
    std::vector<std::string> words = one.words;
    words.push_back("a.pbrt");
    tests::expect_words(ErrorKind::unreadable_input, words, [&] { sim::read_volumegrid(folder / "a.pbrt"); });
  }
  tests::expect_words(ErrorKind::unreadable_input, {"no such file"},
                      [&] { sim::read_volumegrid(folder / "b.pbrt"); });
}

TEST(VolumegridText, TakesNoMoreMemoryThanItMay) {
  const tests::TemporaryFolder folder;
  tests::put(folder / "a.pbrt", kSmall);
  // A brick, and where it is in its layer.
  const std::uint64_t needed = SparseGrid::kVoxels * sizeof(float) + sizeof(float*);
  EXPECT_NO_THROW(sim::read_volumegrid(folder / "a.pbrt", needed));
  tests::expect_words(ErrorKind::unreadable_input, {"memory"},
                      [&] { sim::read_volumegrid(folder / "a.pbrt", needed - 1); });
  tests::expect_words(ErrorKind::unreadable_input, {"memory"},
                      [&] { sim::read_volumegrid(folder / "a.pbrt", 0); });
  // The list of a layer's bricks counts before there is any.
  tests::put(folder / "c.pbrt",
             "Volume \"volumegrid\" \"integer nx\" 65536 \"integer ny\" 65536 \"integer nz\" 1");
  tests::expect_words(ErrorKind::unreadable_input, {"memory"},
                      [&] { sim::read_volumegrid(folder / "c.pbrt", (std::uint64_t{1} << 29) - 1); });
  // The same of densities whose sizes come behind.
  tests::put(folder / "b.pbrt", "Volume \"volumegrid\" \"float density\" [1 2 3 4 5]");
  tests::expect_words(ErrorKind::unreadable_input, {"memory"},
                      [&] { sim::read_volumegrid(folder / "b.pbrt", 4 * sizeof(float)); });
}

TEST(VolumegridText, WritesAllOrNothing) {
  const tests::TemporaryFolder folder;
  tests::put(folder / "a.pbrt", "mine");
  tests::expect_words(ErrorKind::existing_output, {"a.pbrt"},
                      [&] { sim::write_volumegrid(folder / "a.pbrt", scattered(), 1, {}); });
  EXPECT_EQ(tests::bytes_of(folder / "a.pbrt"), "mine");
  SparseGrid turned = scattered();
  turned.axes = {{{0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}};
  tests::expect_words(ErrorKind::unwritable_output, {"turned"},
                      [&] { sim::write_volumegrid(folder / "b.pbrt", turned, 1, {}); });
  SparseGrid wide = scattered();
  wide.brick({1 << 20, 1 << 20, 0})[SparseGrid::kVoxels] = 1.0f;
  tests::expect_words(ErrorKind::unwritable_output, {"numbers", ".vdb"},
                      [&] { sim::write_volumegrid(folder / "b.pbrt", wide, 1, {}); });
  SparseGrid dark;
  dark.channels = {{"density", ""}};
  tests::expect_words(ErrorKind::unwritable_output, {"nothing"},
                      [&] { sim::write_volumegrid(folder / "b.pbrt", dark, 0, {}); });
  EXPECT_EQ(folder.entries(), 1);
}

}  // namespace
}  // namespace vegard::volumegrid_text_test
