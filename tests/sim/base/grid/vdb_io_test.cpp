#include "sim/base/grid/vdb_io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>

#include "sim/base/number/random.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::vdb_io_test {
namespace {

using sim::SparseGrid;

/// Some voxels here and there, of two quantities.
SparseGrid scattered() {
  SparseGrid grid;
  grid.voxel = 0.25;
  grid.origin = {3.0, -2.0, 90.0};
  grid.channels = {{"emission_5577", "photons cm^-3 s^-1"}, {"density", ""}};
  for (std::uint32_t n = 0; n < 40; ++n) {
    const auto words = sim::random_words(5, sim::Stream::path, n, 0, 0);
    const int at[3] = {static_cast<int>(words[0] % 90) - 45, static_cast<int>(words[1] % 90) - 45,
                       static_cast<int>(words[2] % 90) - 45};
    auto& brick = grid.brick({at[0] >> 3, at[1] >> 3, at[2] >> 3});
    const int v = SparseGrid::within(at[0] & 7, at[1] & 7, at[2] & 7);
    brick[v] = 1.0f + n;
    if (n % 2 == 0) brick[SparseGrid::kVoxels + v] = 0.5f * n;
  }
  return grid;
}

using tests::bytes_of;

TEST(VdbIo, GivesBackWhatWasWritten) {
  const tests::TemporaryFolder folder;
  for (const double centre : {0.5, 0.0}) {
    const SparseGrid grid = scattered();
    sim::VdbOptions options;
    options.centre_index = centre;
    options.overwrite = true;
    sim::VdbMetadata metadata;
    metadata.numbers["site_latitude_deg"] = 65.25;
    metadata.texts["scene"] = "seed = 1\n";
    sim::write_vdb(folder / "a.vdb", scattered(), metadata, options);
    const sim::VdbFile back = sim::read_vdb(folder / "a.vdb", {"density", "emission_6300", "emission_5577"});
    EXPECT_EQ(back.names, (std::vector<std::string>{"density", "emission_5577"}));
    ASSERT_EQ(back.grid.channels.size(), 2u);
    EXPECT_EQ(back.grid.channels[0].name, "density");
    EXPECT_EQ(back.grid.channels[1].unit, "photons cm^-3 s^-1");
    EXPECT_EQ(back.grid.voxel, 0.25);
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(back.grid.origin[a], grid.origin[a], 1e-12) << centre;
    EXPECT_EQ(back.metadata.numbers.at("site_latitude_deg"), 65.25);
    EXPECT_EQ(back.metadata.numbers.at(sim::kVoxelCentreIndex), centre);
    EXPECT_EQ(back.metadata.texts.at("scene"), "seed = 1\n");
    int lit = 0;
    for (int i = -48; i < 48; ++i)
      for (int j = -48; j < 48; ++j)
        for (int k = -48; k < 48; ++k) {
          ASSERT_EQ(back.grid.value(1, i, j, k), grid.value(0, i, j, k));
          ASSERT_EQ(back.grid.value(0, i, j, k), grid.value(1, i, j, k));
          lit += grid.value(0, i, j, k) != 0.0f;
        }
    EXPECT_GT(lit, 30);
  }
}

// The library fills short lists of leaves up before it packs them.
TEST(VdbIo, GivesBackAnyNumberOfBricks) {
  const tests::TemporaryFolder folder;
  for (const int bricks : {1, 6, 7, 15, 16, 48, 49, 64, 127, 128, 200}) {
    SparseGrid grid;
    grid.channels = {{"density", "1"}};
    for (int b = 0; b < bricks; ++b) {
      auto& brick = grid.brick({b % 6, b / 6 % 6, b / 36});
      for (int v = 0; v < SparseGrid::kVoxels; ++v)
        brick[v] = static_cast<float>(1.0 + sim::uniform(sim::random_words(3, sim::Stream::search, b, v)[0]));
    }
    const double sum = grid.sum(0);
    sim::VdbOptions options;
    options.overwrite = true;
    sim::write_vdb(folder / "a.vdb", std::move(grid), {}, options);
    EXPECT_EQ(sim::read_vdb(folder / "a.vdb", {"density"}).grid.sum(0), sum) << bricks;
  }
}

TEST(VdbIo, KeepsATurn) {
  const tests::TemporaryFolder folder;
  SparseGrid grid = scattered();
  const double c = std::cos(0.4), s = std::sin(0.4);
  grid.axes = {{{c, s, 0.0}, {-s, c, 0.0}, {0.0, 0.0, 1.0}}};
  const auto axes = grid.axes;
  const auto origin = grid.origin;
  sim::write_vdb(folder / "a.vdb", std::move(grid), {}, {});
  const sim::VdbFile back = sim::read_vdb(folder / "a.vdb", {"emission_5577"});
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(back.grid.origin[a], origin[a], 1e-12);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(back.grid.axes[a][i], axes[a][i], 1e-12);
  }
}

TEST(VdbIo, WritesTheSameBytesForTheSame) {
  const tests::TemporaryFolder folder;
  sim::write_vdb(folder / "a.vdb", scattered(), {}, {});
  sim::write_vdb(folder / "b.vdb", scattered(), {}, {});
  SparseGrid other = scattered();
  other.bricks.begin()->second[0] = 7.0f;
  sim::write_vdb(folder / "c.vdb", std::move(other), {}, {});
  const std::string a = bytes_of(folder / "a.vdb");
  EXPECT_GT(a.size(), 1000u);
  EXPECT_EQ(a, bytes_of(folder / "b.vdb"));
  EXPECT_NE(a.substr(21, 36), bytes_of(folder / "c.vdb").substr(21, 36)) << "a name by what is in it";
}

TEST(VdbIo, ColourIsTheWeightedSum) {
  const tests::TemporaryFolder folder;
  sim::VdbOptions options;
  options.colour_of_channel = {{0.5f, 2.0f, -1.0f}, {0.0f, 0.0f, 0.0f}};
  sim::write_vdb(folder / "a.vdb", scattered(), {}, options);
  const sim::VdbFile back = sim::read_vdb(folder / "a.vdb", {"color"});
  EXPECT_TRUE(back.grid.channels.empty()) << "three numbers a voxel are no light of a line";
  EXPECT_NE(bytes_of(folder / "a.vdb").find("color"), std::string::npos);
}

TEST(VdbIo, RefusesWhatIsNone) {
  const tests::TemporaryFolder folder;
  const auto refused = [&](const char* name) {
    return tests::expect_error(sim::ErrorKind::unreadable_input,
                               [&] { sim::read_vdb(folder / name, {"density"}, 1 << 20); });
  };
  EXPECT_NE(refused("none.vdb").find("none.vdb"), std::string::npos);
  std::ofstream(folder / "text.vdb") << "no voxels";
  EXPECT_NE(refused("text.vdb").find("OpenVDB"), std::string::npos);
  sim::write_vdb(folder / "whole.vdb", scattered(), {}, {});
  const std::string whole = bytes_of(folder / "whole.vdb");
  std::ofstream(folder / "cut.vdb", std::ios::binary) << whole.substr(0, whole.size() / 2);
  EXPECT_NE(refused("cut.vdb").find("OpenVDB"), std::string::npos);
  SparseGrid large = scattered();
  for (int x = 0; x < 600; ++x) large.brick({x, 40, 40})[SparseGrid::kVoxels] = 1.0f;
  sim::write_vdb(folder / "large.vdb", std::move(large), {}, {});
  EXPECT_NE(refused("large.vdb").find("memory"), std::string::npos);
  tests::expect_error(sim::ErrorKind::existing_output,
                      [&] { sim::write_vdb(folder / "whole.vdb", scattered(), {}, {}); });
}

/// What reading some grids of a file says.
std::string refusal(const std::string& path, const std::vector<std::string>& wanted,
                    std::uint64_t max_bytes = std::uint64_t{1} << 30, std::uint64_t bytes_beside = 0) {
  return tests::expect_error(sim::ErrorKind::unreadable_input,
                             [&] { sim::read_vdb(path, wanted, max_bytes, bytes_beside); });
}

TEST(VdbIo, RefusesTwoGridsOfOneName) {
  const tests::TemporaryFolder folder;
  SparseGrid grid = scattered();
  grid.channels[0].name = "color";
  sim::VdbOptions options;
  options.colour_of_channel = {{1.0f, 1.0f, 1.0f}, {0.0f, 0.0f, 0.0f}};
  sim::write_vdb(folder / "a.vdb", std::move(grid), {}, options);
  EXPECT_NE(refusal(folder / "a.vdb", {"color"}).find("'color'"), std::string::npos);
  EXPECT_EQ(sim::read_vdb(folder / "a.vdb", {"density"}).grid.channels.size(), 1u);
}

TEST(VdbIo, RefusesNumbersThatAreNone) {
  const tests::TemporaryFolder folder;
  for (const float number : {3e38f, -2e30f, std::numeric_limits<float>::infinity(), std::nanf("")}) {
    SparseGrid grid = scattered();
    grid.bricks.begin()->second[3] = number;
    sim::VdbOptions options;
    options.overwrite = true;
    sim::write_vdb(folder / "a.vdb", std::move(grid), {}, options);
    EXPECT_NE(refusal(folder / "a.vdb", {"emission_5577"}).find("1e30"), std::string::npos) << number;
  }
}

TEST(VdbIo, RefusesACentreThatIsNone) {
  const tests::TemporaryFolder folder;
  sim::VdbOptions options;
  options.centre_index = std::nan("");
  sim::write_vdb(folder / "a.vdb", scattered(), {}, options);
  refusal(folder / "a.vdb", {"density"});
}

TEST(VdbIo, CountsWhatABrickTakesElsewhere) {
  const tests::TemporaryFolder folder;
  const std::uint64_t bricks = scattered().bricks.size();
  sim::write_vdb(folder / "a.vdb", scattered(), {}, {});
  // The library's own tree takes a few megabytes, whatever is in it.
  const std::uint64_t most = 64 << 20;
  EXPECT_NO_THROW(sim::read_vdb(folder / "a.vdb", {"emission_5577"}, most));
  const std::string text = refusal(folder / "a.vdb", {"emission_5577"}, most, most / bricks + 1);
  EXPECT_NE(text.find("of which 64 MB"), std::string::npos) << text;
}

TEST(VdbIo, EveryCutIsRefused) {
  const tests::TemporaryFolder folder;
  sim::write_vdb(folder / "whole.vdb", scattered(), {}, {});
  const std::string whole = bytes_of(folder / "whole.vdb");
  for (std::size_t length = 0; length < whole.size(); length += 1 + length / 16) {
    std::ofstream(folder / "cut.vdb", std::ios::binary) << whole.substr(0, length);
    EXPECT_NE(refusal(folder / "cut.vdb", {"density"}).find("cut.vdb"), std::string::npos) << length;
  }
}

/// Lengths and places of the file's own outline, each made too large: 255 in their highest byte.
TEST(VdbIo, EveryDamagedByteOfTheOutlineIsReadOrRefused) {
  const tests::TemporaryFolder folder;
  sim::write_vdb(folder / "whole.vdb", scattered(), {}, {});
  const std::string whole = bytes_of(folder / "whole.vdb");
  int refused = 0;
  for (std::size_t at = 0; at < 250; ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(255);
    std::ofstream(folder / "damaged.vdb", std::ios::binary) << damaged;
    try {
      sim::read_vdb(folder / "damaged.vdb", {"density", "emission_5577"}, std::uint64_t{1} << 30);
    } catch (const sim::Error& error) {
      EXPECT_EQ(error.kind(), sim::ErrorKind::unreadable_input);
      ++refused;
    }
  }
  EXPECT_GT(refused, 50);
}

/// Tiles, a leaf that is full, and grids of other kinds are not in every file.
TEST(VdbIo, EveryFlippedBitIsReadOrRefused) {
  const tests::TemporaryFolder folder;
  SparseGrid grid = scattered();
  auto& full = grid.brick({3, 3, 3});
  std::fill(full.begin(), full.end(), 0.75f);
  sim::write_vdb(folder / "whole.vdb", std::move(grid), {}, {});
  const std::string whole = bytes_of(folder / "whole.vdb");
  const std::size_t bits = 8 * whole.size();
  int refused = 0;
  for (std::uint32_t n = 0; n < 400; ++n) {
    const auto words = sim::random_words(9, sim::Stream::path, n, 0, 0);
    const std::size_t bit = words[0] % bits;
    std::string damaged = whole;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ 1 << bit % 8);
    std::ofstream(folder / "damaged.vdb", std::ios::binary) << damaged;
    try {
      sim::read_vdb(folder / "damaged.vdb", {"density", "emission_5577"}, std::uint64_t{1} << 30);
    } catch (const sim::Error& error) {
      EXPECT_EQ(error.kind(), sim::ErrorKind::unreadable_input) << bit;
      ++refused;
    }
  }
  EXPECT_GT(refused, 50);
}

/// Where what stands in a file of one grid: behind the transform a count of buffers and the background, then
/// tiles and nodes of the root.
struct RootPlaces {
  std::size_t buffers, tiles, children, first_node, first_masks;
  explicit RootPlaces(const std::string& file) {
    const std::string map = "UniformScaleTranslateMap";
    EXPECT_NE(file.rfind(map), std::string::npos);
    buffers = file.rfind(map) + map.size() + 6 * 3 * sizeof(double);
    tiles = buffers + 2 * sizeof(std::int32_t);
    children = tiles + sizeof(std::int32_t);
    first_node = children + sizeof(std::int32_t);
    first_masks = first_node + 3 * sizeof(std::int32_t);
  }
};

TEST(VdbIo, ATreeThatTheLibraryWouldBelieveIsRefusedBeforeIt) {
  const tests::TemporaryFolder folder;
  SparseGrid one;
  one.voxel = 0.25;
  one.origin = {1.0, 2.0, 3.0};  // so that the map is the one that RootPlaces looks for
  one.channels = {{"density", ""}};
  one.brick({0, 0, 0})[5] = 1.0f;
  sim::write_vdb(folder / "whole.vdb", std::move(one), {}, {});
  const std::string whole = bytes_of(folder / "whole.vdb");
  const RootPlaces root(whole);
  std::int32_t buffers = 0, children = 0;
  std::memcpy(&buffers, &whole[root.buffers], sizeof buffers);
  std::memcpy(&children, &whole[root.children], sizeof children);
  ASSERT_EQ(buffers, 1);
  ASSERT_EQ(children, 1);
  const auto refused_with = [&](std::size_t at, const std::string& bytes) {
    std::string damaged = whole;
    damaged.replace(at, bytes.size(), bytes);
    std::ofstream(folder / "damaged.vdb", std::ios::binary) << damaged;
    return refusal(folder / "damaged.vdb", {"density"});
  };
  const auto number = [](std::int32_t n) { return std::string(reinterpret_cast<const char*>(&n), sizeof n); };
  EXPECT_NE(refused_with(root.buffers, number(2)).find("several buffers"), std::string::npos);
  EXPECT_NE(refused_with(root.tiles, number(0x7FFFFFFF)).find("more nodes"), std::string::npos);
  EXPECT_NE(refused_with(root.children, number(0x7FFFFFFF)).find("more nodes"), std::string::npos);
  EXPECT_NE(refused_with(root.first_node, number(4095)).find("no place"), std::string::npos);
  // A child where there is a number, too.
  EXPECT_NE(
      refused_with(root.first_masks + 4096, whole.substr(root.first_masks, 4096)).find("number as well"),
      std::string::npos);
  // A tile in place of the node: its yes or no would be a byte that is neither.
  const std::string tile = number(1) + number(0) + number(0) + number(0) + number(0) + number(0) + "\x07";
  EXPECT_NE(refused_with(root.tiles, tile).find("yes or no"), std::string::npos);
  // A packed length of terabytes.
  const std::size_t numbers = root.first_masks + 2 * 4096 + 1;
  const std::int64_t terabytes = std::int64_t{3} << 40;
  EXPECT_NE(refused_with(numbers, std::string(reinterpret_cast<const char*>(&terabytes), sizeof terabytes))
                .find("damaged"),
            std::string::npos);
}

}  // namespace
}  // namespace vegard::vdb_io_test
