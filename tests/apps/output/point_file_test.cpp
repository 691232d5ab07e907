// PLY and CSV read back, byte by byte.
#include "apps/output/point_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "tests/support/expect_error.h"
#include "tests/support/small_scene.h"
#include "tests/support/temporary_folder.h"

namespace vegard::apps::point_file_test {
namespace {

using tests::TemporaryFolder;

/// `count` points along a line; the first is green alone, the second red alone.
sim::EmissionPoints some_points(int count) {
  sim::EmissionPoints points;
  points.lines = 3;
  for (int i = 0; i < count; ++i) {
    for (const float x : {1.5f, -200.25f, 100.0f + i}) points.position_in_enu_km.push_back(x);
    for (const float e : {i % 2 == 1 ? 2e15f : 0.0f, i % 2 == 0 ? 1e15f : 0.0f, 0.0f})
      points.photons_per_s.push_back(e);
  }
  return points;
}

TEST(PointFile, PlyHoldsWhatItsHeaderSays) {
  const TemporaryFolder folder;
  const std::string path = folder / "points.ply";
  constexpr int kPoints = 12;
  {
    PointFile file(path, tests::small_scene(), "m", 3, false);
    file.write(some_points(2));
    file.write(some_points(kPoints - 2));
    EXPECT_EQ(folder.entries(), 1) << "a temporary, not yet the file";
    file.commit();
  }
  EXPECT_EQ(folder.entries(), 1);
  const std::string bytes = tests::bytes_of(path);
  std::istringstream header(bytes);
  std::string line;
  std::vector<std::string> properties, comments;
  int vertices = -1;
  std::getline(header, line);
  EXPECT_EQ(line, "ply");
  std::getline(header, line);
  EXPECT_EQ(line, "format binary_little_endian 1.0");
  while (std::getline(header, line) && line != "end_header") {
    if (line.rfind("comment ", 0) == 0) comments.push_back(line);
    if (line.rfind("element vertex ", 0) == 0) vertices = std::stoi(line.substr(15));
    if (line.rfind("property float ", 0) == 0) properties.push_back(line.substr(15));
  }
  EXPECT_EQ(vertices, kPoints);
  EXPECT_EQ(properties, (std::vector<std::string>{"x", "y", "z", "line_6300", "line_5577", "line_4278", "red",
                                                  "green", "blue"}));
  EXPECT_NE(bytes.find("in m, the observer at the origin"), std::string::npos);
  EXPECT_NE(bytes.find("one of 3 beams"), std::string::npos);
  const std::size_t data = static_cast<std::size_t>(header.tellg());
  ASSERT_EQ(bytes.size() - data, kPoints * properties.size() * 4);
  std::vector<float> numbers(kPoints * properties.size());
  std::memcpy(numbers.data(), bytes.data() + data, numbers.size() * 4);
  EXPECT_EQ(numbers[0], 1500.0f);
  EXPECT_EQ(numbers[1], -200250.0f);
  EXPECT_EQ(numbers[2], 100000.0f);
  EXPECT_EQ(numbers[4], 1e15f);
  // docs/optics.md row B24: 557.7 nm is (0.210, 1.381, -0.161) in SMPTE-C, about so in sRGB; 630.0 nm is
  // red.
  EXPECT_EQ(numbers[7], 1.0f);
  EXPECT_EQ(numbers[8], 0.0f);
  EXPECT_LT(numbers[6], 0.5f);
  EXPECT_EQ(numbers[9 + 6], 1.0f);
  EXPECT_LT(numbers[9 + 7], 0.1f);
}

TEST(PointFile, CsvHasANameForEveryColumn) {
  const TemporaryFolder folder;
  PointFile file(folder / "points.CSV", tests::small_scene(), "km", 1, false);
  file.write(some_points(1));
  file.commit();
  std::istringstream text(tests::bytes_of(folder / "points.CSV"));
  std::string line;
  while (std::getline(text, line) && line[0] == '#') {
  }
  EXPECT_EQ(line, "x,y,z,line_6300,line_5577,line_4278,red,green,blue");
  std::getline(text, line);
  EXPECT_EQ(line.rfind("1.5,-200.25,100,0,1000000000000000,0,", 0), 0u) << line;
}

TEST(PointFile, AppearsWholeOrNotAtAll) {
  const TemporaryFolder folder;
  const std::string path = folder / "points.ply";
  { PointFile file(path, tests::small_scene(), "km", 1, false); }
  EXPECT_EQ(folder.entries(), 0);
  {
    const tests::FullDisk full(20000);
    tests::expect_words(sim::ErrorKind::unwritable_output, {path}, [&] {
      PointFile file(path, tests::small_scene(), "km", 1, false);
      file.write(some_points(1000));
      file.commit();
    });
  }
  EXPECT_EQ(folder.entries(), 0);
  tests::put(path, "precious");
  tests::expect_words(sim::ErrorKind::existing_output, {path},
                      [&] { PointFile file(path, tests::small_scene(), "km", 1, false); });
  tests::expect_words(sim::ErrorKind::usage, {"points.obj", ".ply"}, [] { point_format("points.obj"); });
}

}  // namespace
}  // namespace vegard::apps::point_file_test
