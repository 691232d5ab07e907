#include "fit/report/run_directory.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "sim/base/picture/image_io.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_fit.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::run_directory_test {
namespace {

namespace fs = std::filesystem;
using tests::bytes_of;
using tests::expect_error;
using tests::TemporaryFolder;

class RunDirectory : public ::testing::Test {
 protected:
  void write(const std::string& name, bool overwrite = false) {
    write_run(folder / name, overwrite, result, photo, {1});
  }
  std::set<std::string> files(const std::string& name) const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder / name)) names.insert(entry.path().filename());
    return names;
  }
  TemporaryFolder folder;
  Photo photo = tests::small_photo();
  FitResult result = tests::small_fit(photo);
};

TEST_F(RunDirectory, HoldsAllFilesAndNothingElse) {
  write("run");
  EXPECT_EQ(files("run"), (std::set<std::string>{"best.toml", "map.svg", "model.exr", "profiles.csv",
                                                 "report.html", "residual.exr", "result.json", "trace.csv"}));
  EXPECT_EQ(folder.entries(), 1);
}

TEST_F(RunDirectory, HasTheSameBytesForAnyNumberOfThreads) {
  write_run(folder / "a", false, result, photo, {1});
  write_run(folder / "b", false, result, photo, {2});
  for (const std::string& name : files("a"))
    EXPECT_TRUE(bytes_of(folder / ("a/" + name)) == bytes_of(folder / ("b/" + name))) << name;
}

TEST_F(RunDirectory, HoldsTheBestSceneAsAScene) {
  result.verdict_line = "Doubtful:\nseed = 3 \x01";
  write("run");
  const sim::Scene scene = sim::read_scene(folder / "run/best.toml");
  EXPECT_EQ(sim::write_scene(scene), sim::write_scene(result.best));
  EXPECT_EQ(scene.seed, result.seed);
  EXPECT_NE(bytes_of(folder / "run/best.toml").find("\n# The best scene of a fit. vegard "), std::string::npos);
}

// What a scene reads beside it is not copied, grids may be large: the best scene calls it as it is called
// from the run's directory.
TEST_F(RunDirectory, FindsFilesBesideTheSceneAgain) {
  result.best.file = folder / "scenes/aurora.toml";
  result.best.composite.background = "pictures/hill.jpg";
  result.best.composite.mask = "/elsewhere/mask.png";
  write("run");
  const sim::Scene scene = sim::read_scene(folder / "run/best.toml");
  EXPECT_EQ(scene.composite.background, "../scenes/pictures/hill.jpg");
  EXPECT_EQ(scene.composite.mask, "/elsewhere/mask.png");
}

TEST_F(RunDirectory, HoldsThePictures) {
  result.photos[0].best.site.time_utc = "2019-09-05T22:11:12Z";
  write("run");
  const sim::ExrFile model = sim::read_exr(folder / "run/model.exr");
  EXPECT_EQ(model.image.channel_names,
            (std::vector<std::string>{"R", "G", "B", "rayleigh.4278", "rayleigh.5577", "rayleigh.6300"}));
  EXPECT_EQ(model.attributes.at("seed"), "9223372036854775807");
  EXPECT_NE(model.attributes.at("gain").find("linear between"), std::string::npos);
  EXPECT_EQ(model.attributes.at("scene"), sim::write_scene(result.photos[0].best));
  const sim::ExrFile residual = sim::read_exr(folder / "run/residual.exr");
  for (int c = 0; c < 3; ++c)
    EXPECT_FLOAT_EQ(residual.image.at(7, 5, c), photo.linear.at(7, 5, c) - model.image.at(7, 5, c));
}

TEST_F(RunDirectory, RefusesWhatExists) {
  write("run");
  const std::string before = bytes_of(folder / "run/result.json");
  result.chi2 = 99.0;
  expect_error(sim::ErrorKind::existing_output, [&] { write("run"); });
  expect_error(sim::ErrorKind::existing_output, [&] { check_run_directory(folder / "run", false); });
  EXPECT_EQ(bytes_of(folder / "run/result.json"), before);
  EXPECT_NO_THROW(check_run_directory(folder / "run", true));
  write("run", true);
  EXPECT_NE(bytes_of(folder / "run/result.json"), before);
  EXPECT_EQ(folder.entries(), 1);
}

// Whatever vegard has written may be replaced, tables and several photographs' files too; and of another
// program's result.json, or beside the run's own files, nothing.
TEST_F(RunDirectory, ReplacesWhatVegardWroteAndNothingElse) {
  result.best.sheets[0].profile = sim::ProfileKind::file;
  result.best.sheets[0].profile_file = "tables/mine.csv";
  result.best.tables["sheet.main.profile_file"] = "altitude_km,rate_5577\n90,0\n120,1\n150,0\n";
  FittedPhoto second = result.photos[0];
  result.photos[0].name = "north";
  second.name = "south";
  result.photos.push_back(second);
  const auto write_both = [&](bool overwrite) {
    write_run(folder / "run", overwrite, result, std::vector<Photo>{photo, photo}, {1});
  };
  write_both(false);
  EXPECT_EQ(files("run").count("mine.csv"), 1U);
  EXPECT_EQ(files("run").count("model-south.exr"), 1U);
  write_both(true);
  EXPECT_EQ(folder.entries(), 1);
  tests::put(folder / "run/other.csv", "mine");
  tests::put(folder / "run/model-west.exr", "mine");
  const std::string said = expect_error(sim::ErrorKind::existing_output, [&] { write_both(true); });
  EXPECT_NE(said.find("model-west.exr, other.csv in it are"), std::string::npos) << said;
  fs::remove(folder / "run/other.csv");
  fs::remove(folder / "run/model-west.exr");
  for (const char* text : {"", "{}", R"({"verdict": "good", "parameters": [], "version": "3"})", "[[["}) {
    tests::put(folder / "run/result.json", text);
    expect_error(sim::ErrorKind::existing_output, [&] { write_both(true); });
    EXPECT_EQ(bytes_of(folder / "run/result.json"), text);
    EXPECT_EQ(files("run").count("best.toml"), 1U);
  }
}

// As the first version wrote it, before several photographs, validation of error bars and tied numbers.
TEST_F(RunDirectory, ReplacesARunOfAnOlderVersion) {
  fs::create_directory(folder / "run");
  tests::put(folder / "run/result.json",
             R"({"verdict": "good", "verdict_line": "Good.", "reasons": [], "parameters": [], "solved": [],
                 "derived": [], "correlation": [], "chi2": 1.0, "dof": 3, "seed": 1, "version": "0.0.1",
                 "libraries": {"ceres": "2.1.0", "opencv": "4.6.0"}, "command": "", "inputs": [],
                 "decoding": "sRGB"})");
  for (const char* name :
       {"best.toml", "profiles.csv", "trace.csv", "model.exr", "residual.exr", "report.html"})
    tests::put(folder / "run/" + name, "old");
  write("run", true);
  EXPECT_NE(bytes_of(folder / "run/best.toml"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST_F(RunDirectory, LeavesNothingOnAFullDisk) {
  for (const rlim_t bytes : {100, 5000, 20000}) {
    const tests::FullDisk full(bytes);
    const std::string text = expect_error(sim::ErrorKind::unwritable_output, [&] { write("run"); });
    EXPECT_NE(text.find("/run/"), std::string::npos) << text;
    EXPECT_EQ(text.find("partial"), std::string::npos) << text;
    EXPECT_EQ(folder.entries(), 0);
  }
}

TEST_F(RunDirectory, KeepsTheOldRunOnAFullDisk) {
  write("run");
  const std::string before = bytes_of(folder / "run/report.html");
  const tests::FullDisk full(5000);
  expect_error(sim::ErrorKind::unwritable_output, [&] { write("run", true); });
  EXPECT_TRUE(bytes_of(folder / "run/report.html") == before);
  EXPECT_EQ(folder.entries(), 1);
}

}  // namespace
}  // namespace vegard::fit::run_directory_test
