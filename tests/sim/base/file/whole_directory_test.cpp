#include "sim/base/file/whole_directory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "sim/base/file/durable_rename.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::whole_directory_test {
namespace {

namespace fs = std::filesystem;
using tests::bytes_of;
using tests::expect_error;
using tests::put;
using tests::TemporaryFolder;

/// Recognised by a result.json that says so; holds that and tables called "t1.csv", "t2.csv", ….
DirectoryKind kind() {
  return {"a run",
          [](const std::string& directory) {
            KnownFolder known;
            if (bytes_of(directory + "/result.json").rfind("run", 0) != 0) known.objection = "it has no mark";
            known.has = [](const std::string& name) {
              return name == "result.json" || (name[0] == 't' && name.find(".csv") == name.size() - 4);
            };
            return known;
          },
          {"result.json"}};
}

class Replacement : public ::testing::Test {
 protected:
  Replacement() {
    fs::create_directory(folder / "run");
    put(folder / "run/result.json", "run, old");
    put(folder / "run/t1.csv", "old");
    put(folder / "elsewhere", "precious");
  }
  /// That the run is neither replaced nor touched, before the work and at its end, and what is said of it.
  std::string refusal() {
    const std::string said =
        expect_error(ErrorKind::existing_output, [&] { WholeDirectory(folder / "run", true, kind()); });
    EXPECT_EQ(bytes_of(folder / "run/result.json").substr(0, 8), "run, old");
    EXPECT_EQ(bytes_of(folder / "run/t1.csv"), "old");
    EXPECT_EQ(bytes_of(folder / "elsewhere"), "precious");
    EXPECT_EQ(folder.entries(), 2);
    return said;
  }
  TemporaryFolder folder;
};

TEST(WholeDirectory, AppearsWithEverythingInItAtCommit) {
  TemporaryFolder folder;
  WholeDirectory run(folder / "run", false, kind());
  put(run.file("result.json"), "{}");
  fs::create_directory(run.file("plots"));
  put(run.file("plots/a.svg"), "<svg/>");
  EXPECT_FALSE(fs::exists(folder / "run"));
  run.commit();
  EXPECT_EQ(bytes_of(folder / "run/result.json"), "{}");
  EXPECT_EQ(bytes_of(folder / "run/plots/a.svg"), "<svg/>");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WholeDirectory, WithoutCommitNothingRemains) {
  TemporaryFolder folder;
  {
    WholeDirectory run(folder / "runs/today/run/", false, kind());
    put(run.file("result.json"), "{}");
  }
  EXPECT_EQ(folder.entries(), 0);
}

// A signal ends the process in the midst of it: nothing of what is not finished stays.
TEST(WholeDirectory, OfAnEndedProcessNothingRemains) {
  TemporaryFolder folder;
  WholeDirectory finished(folder / "finished", false, kind());
  WholeDirectory run(folder / "run", false, kind());
  put(finished.file("result.json"), "{}");
  put(run.file("result.json"), "{}");
  fs::create_directory(run.file("plots"));
  put(run.file("plots/a.svg"), "<svg/>");
  finished.commit();
  EXPECT_EQ(folder.entries(), 2);
  EXPECT_EXIT((delete_unfinished_files(), ::_exit(0)), testing::ExitedWithCode(0), "");
  EXPECT_EQ(folder.entries(), 1);
  EXPECT_TRUE(fs::exists(folder / "finished/result.json"));
}

TEST(WholeDirectory, MakesMissingParents) {
  TemporaryFolder folder;
  WholeDirectory run(folder / "runs/today/run/", false, kind());
  put(run.file("result.json"), "{}");
  run.commit();
  EXPECT_EQ(bytes_of(folder / "runs/today/run/result.json"), "{}");
}

TEST(WholeDirectory, ReplacesARunOnlyWhenToldToAndOnlyAtCommit) {
  TemporaryFolder folder;
  fs::create_directory(folder / "run");
  put(folder / "run/result.json", "run, old");
  put(folder / "run/t1.csv", "old");
  const std::string message =
      expect_error(ErrorKind::existing_output, [&] { WholeDirectory(folder / "run", false, kind()); });
  EXPECT_NE(message.find("--overwrite"), std::string::npos) << message;
  {
    WholeDirectory abandoned(folder / "run", true, kind());
    put(abandoned.file("result.json"), "half");
  }
  EXPECT_EQ(bytes_of(folder / "run/result.json"), "run, old");

  WholeDirectory run(folder / "run", true, kind());
  put(run.file("result.json"), "new");
  EXPECT_EQ(bytes_of(folder / "run/result.json"), "run, old");
  run.commit();
  EXPECT_EQ(bytes_of(folder / "run/result.json"), "new");
  EXPECT_FALSE(fs::exists(folder / "run/t1.csv"));
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WholeDirectory, AnEmptyDirectoryMayBeReplaced) {
  TemporaryFolder folder;
  fs::create_directory(folder / "run");
  WholeDirectory run(folder / "run", true, kind());
  put(run.file("result.json"), "new");
  run.commit();
  EXPECT_EQ(bytes_of(folder / "run/result.json"), "new");
}

TEST(WholeDirectory, NeverReplacesWhatIsNotARun) {
  TemporaryFolder folder;
  fs::create_directory(folder / "photos");
  put(folder / "photos/aurora.jpg", "precious");
  put(folder / "file", "precious");
  expect_error(ErrorKind::existing_output, [&] { WholeDirectory(folder / "photos", true, kind()); });
  expect_error(ErrorKind::existing_output, [&] { WholeDirectory(folder / "file", true, kind()); });
  EXPECT_EQ(bytes_of(folder / "photos/aurora.jpg"), "precious");
  EXPECT_EQ(bytes_of(folder / "file"), "precious");
}

TEST_F(Replacement, WhatIsTheUsersIsNamedAndKept) {
  put(folder / "run/thesis.tex", "years");
  const std::string said = refusal();
  EXPECT_NE(said.find("thesis.tex"), std::string::npos) << said;
  EXPECT_EQ(bytes_of(folder / "run/thesis.tex"), "years");
}

TEST_F(Replacement, OfManyAFewAreNamedAndTheOthersCounted) {
  for (const char* name : {"a", "b", "c", "d", "e"}) put(folder / "run/" + name, "mine");
  const std::string said = refusal();
  EXPECT_TRUE(tests::has_facts(said, "a, b, c | 2 more")) << said;
}

TEST_F(Replacement, AFolderOrALinkUnderAKnownNameIsTheUsers) {
  fs::create_directory(folder / "run/t2.csv");
  put(folder / "run/t2.csv/thesis.tex", "years");
  fs::create_symlink(folder / "elsewhere", folder / "run/t3.csv");
  const std::string said = refusal();
  EXPECT_NE(said.find("t2.csv (a folder), t3.csv (a link)"), std::string::npos) << said;
  EXPECT_EQ(bytes_of(folder / "run/t2.csv/thesis.tex"), "years");
}

TEST_F(Replacement, AnotherProgramsMarkIsNone) {
  put(folder / "run/result.json", "");
  const std::string said =
      expect_error(ErrorKind::existing_output, [&] { WholeDirectory(folder / "run", true, kind()); });
  EXPECT_NE(said.find("it has no mark"), std::string::npos) << said;
  EXPECT_EQ(bytes_of(folder / "run/t1.csv"), "old");
}

TEST_F(Replacement, WhatIsPutThereDuringTheWorkIsKept) {
  {
    WholeDirectory run(folder / "run", true, kind());
    put(run.file("result.json"), "run, new");
    put(folder / "run/thesis.tex", "years");
    const std::string said = expect_error(ErrorKind::existing_output, [&] { run.commit(); });
    EXPECT_NE(said.find("thesis.tex"), std::string::npos) << said;
  }
  refusal();
  EXPECT_EQ(bytes_of(folder / "run/thesis.tex"), "years");
}

TEST_F(Replacement, WhatIsPutThereAtTheLastMomentBringsTheOldFolderBack) {
  int looks = 0;
  DirectoryKind last_moment = kind();
  last_moment.look = [&looks, this](const std::string& directory) {
    // The third look is that at the old folder after the exchange, when it has another name already.
    if (++looks == 3) put(directory + "/thesis.tex", "years");
    return kind().look(directory);
  };
  {
    WholeDirectory run(folder / "run", true, last_moment);
    put(run.file("result.json"), "run, new");
    expect_error(ErrorKind::existing_output, [&] { run.commit(); });
  }
  EXPECT_EQ(looks, 3);
  refusal();
  EXPECT_EQ(bytes_of(folder / "run/thesis.tex"), "years");
}

TEST_F(Replacement, TheFolderOneStandsInIsKept) {
  const fs::path before = fs::current_path();
  fs::current_path(folder / "run");
  for (const std::string& name : {std::string("."), folder / "run"}) {
    const std::string said =
        expect_error(ErrorKind::existing_output, [&] { WholeDirectory(name, true, kind()); });
    EXPECT_NE(said.find("the current folder"), std::string::npos) << said;
  }
  fs::current_path(before);
}

TEST(WholeDirectory, TheRootAndWhereADiskIsMountedAreKept) {
  for (const char* name : {"/", "/proc"})
    expect_error(ErrorKind::existing_output, [&] { WholeDirectory(name, true, kind()); });
}

TEST(WholeDirectory, TheHomeFolderIsKeptEvenIfItIsEmpty) {
  TemporaryFolder folder;
  fs::create_directory(folder / "home");
  const char* const old = std::getenv("HOME");
  const std::string home = old == nullptr ? "" : old;
  ::setenv("HOME", (folder / "home").c_str(), 1);
  expect_error(ErrorKind::existing_output, [&] { WholeDirectory(folder / "home", true, kind()); });
  if (old == nullptr)
    ::unsetenv("HOME");
  else
    ::setenv("HOME", home.c_str(), 1);
}

TEST(WholeDirectory, WhatHasBecomeSomethingElseSinceIsNotReplaced) {
  TemporaryFolder folder;
  WholeDirectory run(folder / "run", true, kind());
  put(run.file("result.json"), "new");
  fs::create_directory(folder / "run");
  put(folder / "run/aurora.jpg", "precious");
  expect_error(ErrorKind::existing_output, [&] { run.commit(); });
  EXPECT_EQ(bytes_of(folder / "run/aurora.jpg"), "precious");
}

TEST(WholeDirectory, WhatCannotBeMadeIsSaidBeforeTheWork) {
  TemporaryFolder folder;
  put(folder / "file", "");
  expect_error(ErrorKind::unwritable_output, [&] { WholeDirectory(folder / "file/run", false, kind()); });
  expect_error(ErrorKind::unwritable_output, [&] { WholeDirectory("/proc/run", false, kind()); });
  expect_error(ErrorKind::unwritable_output, [&] { WholeDirectory("", false, kind()); });
  EXPECT_EQ(folder.entries(), 1);
}

TEST(DurableRename, NeverReplacesWithoutLeave) {
  TemporaryFolder folder;
  put(folder / "from", "new");
  put(folder / "to", "old");
  EXPECT_EQ(rename_to_free_name(folder / "from", folder / "to"), EEXIST);
  EXPECT_EQ(bytes_of(folder / "to"), "old");
}

}  // namespace
}  // namespace vegard::sim::whole_directory_test
