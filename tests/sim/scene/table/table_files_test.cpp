#include "sim/scene/table/table_files.h"

#include <gtest/gtest.h>

#include <fstream>

#include "sim/base/error.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::table_files_test {
namespace {

void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

TEST(TableFiles, AreReadFromBesideTheScene) {
  const tests::TemporaryFolder folder;
  write(folder / "curve.csv", "altitude_km,557.7\n100,1\n");
  write(folder / "scene.toml", "[[sheet]]\nprofile_file = \"curve.csv\"\n");
  const Scene scene = read_scene(folder / "scene.toml");
  EXPECT_EQ(table_text(scene, "sheet.main.profile_file"), "altitude_km,557.7\n100,1\n");
}

TEST(TableFiles, OneThatIsNotThereIsRefusedAtItsKey) {
  const tests::TemporaryFolder folder;
  write(folder / "scene.toml", "seed = 1\n[[sheet]]\nprofile_file = \"curve.csv\"\n");
  try {
    read_scene(folder / "scene.toml");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.details().line, 3);
    EXPECT_EQ(error.details().key, "sheet.main.profile_file");
    EXPECT_NE(error.details().problem.find("no such file"), std::string::npos);
  }
}

TEST(TableFiles, GetNamesOfTheirOwnInAnotherFolder) {
  Scene scene;
  scene.sheets.resize(3);
  scene.sheets[0].profile_file = "a/curve.csv";
  scene.sheets[1].name = "other";
  scene.sheets[1].profile_file = "b/curve.csv";
  scene.sheets[2].name = "third";
  const std::vector<TableFile> moved = table_files(with_tables_beside(scene));
  ASSERT_EQ(moved.size(), 2u);
  EXPECT_EQ(moved[0].name, "curve.csv");
  EXPECT_EQ(moved[1].name, "sheet.other.profile_file.csv");
}

TEST(TableFiles, ADecodingKeepsTheWordBeforeItsTable) {
  Scene scene;
  scene.fit.decoding = "curve:a/camera.csv";
  const std::vector<TableFile> files = table_files(scene);
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0].path, "fit.decoding");
  EXPECT_EQ(files[0].name, "a/camera.csv");
  EXPECT_EQ(scene.fit.decoding, "curve:a/camera.csv");
  EXPECT_EQ(with_tables_beside(scene).fit.decoding, "curve:camera.csv");
}

}  // namespace
}  // namespace vegard::sim::table_files_test
