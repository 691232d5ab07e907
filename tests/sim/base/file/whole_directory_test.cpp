#include "sim/base/file/whole_directory.h"

#include <gtest/gtest.h>

#include <cerrno>
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

TEST(WholeDirectory, AppearsWithEverythingInItAtCommit) {
  TemporaryFolder folder;
  WholeDirectory run(folder / "run");
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
    WholeDirectory run(folder / "runs/today/run/");
    put(run.file("result.json"), "{}");
  }
  EXPECT_EQ(folder.entries(), 0);
}

TEST(WholeDirectory, MakesMissingParents) {
  TemporaryFolder folder;
  WholeDirectory run(folder / "runs/today/run/");
  put(run.file("result.json"), "{}");
  run.commit();
  EXPECT_EQ(bytes_of(folder / "runs/today/run/result.json"), "{}");
}

TEST(WholeDirectory, ReplacesARunOnlyWhenToldToAndOnlyAtCommit) {
  TemporaryFolder folder;
  fs::create_directory(folder / "run");
  put(folder / "run/result.json", "old");
  put(folder / "run/leftover.csv", "old");
  const std::string message =
      expect_error(ErrorKind::existing_output, [&] { WholeDirectory(folder / "run"); });
  EXPECT_NE(message.find("--overwrite"), std::string::npos) << message;
  {
    WholeDirectory abandoned(folder / "run", true);
    put(abandoned.file("result.json"), "half");
  }
  EXPECT_EQ(bytes_of(folder / "run/result.json"), "old");

  WholeDirectory run(folder / "run", true);
  put(run.file("result.json"), "new");
  EXPECT_EQ(bytes_of(folder / "run/result.json"), "old");
  run.commit();
  EXPECT_EQ(bytes_of(folder / "run/result.json"), "new");
  EXPECT_FALSE(fs::exists(folder / "run/leftover.csv"));
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WholeDirectory, AnEmptyDirectoryMayBeReplaced) {
  TemporaryFolder folder;
  fs::create_directory(folder / "run");
  WholeDirectory run(folder / "run", true);
  put(run.file("result.json"), "new");
  run.commit();
  EXPECT_EQ(bytes_of(folder / "run/result.json"), "new");
}

TEST(WholeDirectory, NeverReplacesWhatIsNotARun) {
  TemporaryFolder folder;
  fs::create_directory(folder / "photos");
  put(folder / "photos/aurora.jpg", "precious");
  put(folder / "file", "precious");
  expect_error(ErrorKind::existing_output, [&] { WholeDirectory(folder / "photos", true); });
  expect_error(ErrorKind::existing_output, [&] { WholeDirectory(folder / "file", true); });
  EXPECT_EQ(bytes_of(folder / "photos/aurora.jpg"), "precious");
  EXPECT_EQ(bytes_of(folder / "file"), "precious");
}

TEST(WholeDirectory, WhatHasBecomeSomethingElseSinceIsNotReplaced) {
  TemporaryFolder folder;
  WholeDirectory run(folder / "run", true);
  put(run.file("result.json"), "new");
  fs::create_directory(folder / "run");
  put(folder / "run/aurora.jpg", "precious");
  expect_error(ErrorKind::existing_output, [&] { run.commit(); });
  EXPECT_EQ(bytes_of(folder / "run/aurora.jpg"), "precious");
}

TEST(WholeDirectory, WhatCannotBeMadeIsSaidBeforeTheWork) {
  TemporaryFolder folder;
  put(folder / "file", "");
  expect_error(ErrorKind::unwritable_output, [&] { WholeDirectory(folder / "file/run"); });
  expect_error(ErrorKind::unwritable_output, [&] { WholeDirectory("/proc/run"); });
  expect_error(ErrorKind::unwritable_output, [&] { WholeDirectory(""); });
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
