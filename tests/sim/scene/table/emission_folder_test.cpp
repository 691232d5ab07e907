#include "sim/scene/table/emission_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sim/base/data_folders.h"
#include "sim/base/error.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/table_files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::emission_folder_test {
namespace {

void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

/// A folder "own" with the files that there must be.
void make_folder(const tests::TemporaryFolder& folder) {
  std::filesystem::create_directory(folder / "own");
  for (const char* file : {kMaxwellianFile, kColumnsFile, kFluxesFile, kTablesAirFile})
    write(folder / ("own/" + std::string(file)), std::string("text of ") + file);
  write(folder / "scene.toml", "seed = 1\n[emission]\ntables = \"own\"\n");
}

TEST(EmissionFolder, IsReadWithTheSceneOnce) {
  const tests::TemporaryFolder folder;
  make_folder(folder);
  const Scene scene = read_scene(folder / "scene.toml"), again = read_scene(folder / "scene.toml");
  ASSERT_NE(scene.emission.folder, nullptr);
  EXPECT_EQ(scene.emission.folder, again.emission.folder);
  EXPECT_EQ(scene.emission.folder->files.size(), 4u);
  EXPECT_EQ(scene.emission.folder->files.at(kFluxesFile), "text of linearity_Q.csv");
  EXPECT_TRUE(same_values(scene, again));
  const auto sums = table_sums(scene);
  ASSERT_EQ(sums.size(), 4u);
  EXPECT_EQ(sums[0].first, "emission.tables/atmosphere.csv");
  // A file that changes or comes makes it another.
  write(folder / ("own/" + std::string(kMonoFile)), "more");
  const Scene changed = read_scene(folder / "scene.toml");
  EXPECT_NE(changed.emission.folder, scene.emission.folder);
  EXPECT_EQ(changed.emission.folder->files.at(kMonoFile), "more");
  EXPECT_FALSE(same_values(scene, changed));
}

TEST(EmissionFolder, ThatIsNotWholeIsRefusedAtItsKey) {
  const tests::TemporaryFolder folder;
  make_folder(folder);
  std::filesystem::remove(folder / ("own/" + std::string(kFluxesFile)));
  const auto read = [&] { read_scene(folder / "scene.toml"); };
  const std::string without_file = tests::expect_error(ErrorKind::unreadable_input, read);
  for (const char* word : {"scene.toml:3", "emission.tables", "own/linearity_Q.csv", "no such file"})
    EXPECT_NE(without_file.find(word), std::string::npos) << word << "\n" << without_file;
  std::filesystem::remove_all(folder / "own");
  const std::string without = tests::expect_error(ErrorKind::unreadable_input, read);
  for (const char* word : {"scene.toml:3", "emission.tables", "/own'", "no such folder", "\"glow\""})
    EXPECT_NE(without.find(word), std::string::npos) << word << "\n" << without;
}

TEST(EmissionFolder, ComesWithTheProgramByName) {
  EXPECT_TRUE(are_built_in_tables("glow"));
  EXPECT_FALSE(are_built_in_tables("./glow"));
  EXPECT_TRUE(are_built_in_tables(kDefaultEmissionTables));
  EXPECT_EQ(built_in_tables("glow"), built_in_tables("glow"));
  EXPECT_EQ(built_in_tables("glow")->files.count(kMaxwellianFile), 1u);
  // What is compiled in is under the program's own licence (NOTICE).
  EXPECT_FALSE(embedded_table("emission/" + std::string(kMaxwellianFile)).empty());
  EXPECT_TRUE(embedded_table("glow/" + std::string(kMaxwellianFile)).empty());
  tests::expect_error(ErrorKind::unreadable_input, [] { built_in_tables("own"); });
  Scene scene;
  const auto beside = [](const std::string& name) { return "../" + name; };
  rename_emission_folder(scene, beside);
  EXPECT_EQ(scene.emission.tables, kDefaultEmissionTables);
  scene.emission.tables = "own";
  rename_emission_folder(scene, beside);
  EXPECT_EQ(scene.emission.tables, "../own");
}

TEST(DataFolders, BeginWithTheEnvironmentsAndHaveTheSources) {
  const tests::TemporaryFolder folder;
  ::unsetenv("VEGARD_DATA");
  const std::string of_sources = find_data_file("glow/glowlicense.txt");
  EXPECT_FALSE(of_sources.empty());
  EXPECT_EQ(find_data_file("glow/no_such_file"), "");
  std::filesystem::create_directory(folder / "glow");
  write(folder / "glow/glowlicense.txt", "mine");
  ::setenv("VEGARD_DATA", (folder / "").c_str(), 1);
  EXPECT_EQ(find_data_file("glow/glowlicense.txt"), folder / "glow/glowlicense.txt");
  EXPECT_EQ(find_data_file("glow/atmosphere.csv").find(folder / ""), std::string::npos)
      << "what it lacks is elsewhere";
  EXPECT_NE(find_data_file("glow/atmosphere.csv"), "");
  ::unsetenv("VEGARD_DATA");
}

}  // namespace
}  // namespace vegard::sim::emission_folder_test
