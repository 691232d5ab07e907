#include "sim/base/file/whole_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "sim/base/file/durable_rename.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::whole_file_test {
namespace {

using tests::bytes_of;
using tests::expect_error;
using tests::FullDisk;
using tests::put;
using tests::TemporaryFolder;

TEST(WholeFile, WritesExactlyTheBytesAndNothingBeside) {
  TemporaryFolder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  write_whole(folder / "a.bin", bytes);
  EXPECT_EQ(bytes_of(folder / "a.bin"), bytes);
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WholeFile, OfAProgramThatEndsAtOnceTheUnfinishedAreDeletedAndNoOthers) {
  TemporaryFolder folder;
  WholeFile finished(folder / "finished"), unfinished(folder / "unfinished");
  { WholeFile given_up(folder / "given up"); }
  finished.commit();
  EXPECT_EQ(folder.entries(), 2);
  EXPECT_EXIT((delete_unfinished_files(), ::_exit(0)), testing::ExitedWithCode(0), "");
  EXPECT_EQ(folder.entries(), 1);
  EXPECT_TRUE(std::filesystem::exists(folder / "finished"));
}

TEST(WholeFile, TheTargetIsAbsentUntilCommit) {
  TemporaryFolder folder;
  WholeFile file(folder / "a.exr");
  EXPECT_EQ(std::filesystem::path(file.temporary()).extension(), ".exr");
  file.write("half");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
  file.commit();
  EXPECT_EQ(bytes_of(folder / "a.exr"), "half");
}

TEST(WholeFile, WithoutCommitNothingRemains) {
  TemporaryFolder folder;
  { WholeFile(folder / "a.txt").write("half"); }
  EXPECT_EQ(folder.entries(), 0);
}

TEST(WholeFiles, AppearTogetherAndWhatWasClaimedForNothingLeavesNoTrace) {
  TemporaryFolder folder;
  {
    WholeFiles files({folder / "a.txt", "", folder / "b.txt", folder / "c.txt"}, false);
    files.write(folder / "b.txt", "b");
    files.write("", "nowhere");
    files.file(folder / "a.txt").write("half");
    files.write(folder / "a.txt", "a");
    EXPECT_FALSE(std::filesystem::exists(folder / "b.txt"));
    files.commit();
    EXPECT_EQ(files.written(), (std::vector<std::string>{folder / "b.txt", folder / "a.txt"}));
  }
  EXPECT_EQ(bytes_of(folder / "a.txt"), "a");
  EXPECT_EQ(bytes_of(folder / "b.txt"), "b");
  EXPECT_EQ(folder.entries(), 2);
}

TEST(WholeFiles, AnOutputThatExistsIsRefusedBeforeAnyIsWritten) {
  TemporaryFolder folder;
  put(folder / "b.txt", "kept");
  const std::string message = expect_error(ErrorKind::existing_output, [&] {
    WholeFiles({folder / "a.txt", folder / "b.txt"}, false);
  });
  EXPECT_NE(message.find("b.txt"), std::string::npos);
  EXPECT_EQ(folder.entries(), 1);
  EXPECT_EQ(bytes_of(folder / "b.txt"), "kept");
}

TEST(WholeFile, TwoForOneTargetDoNotShareATemporary) {
  TemporaryFolder folder;
  WholeFile first(folder / "a.txt"), second(folder / "a.txt");
  EXPECT_NE(first.temporary(), second.temporary());
}

TEST(WholeFile, RefusesAnExistingFileUnlessToldToReplaceIt) {
  TemporaryFolder folder;
  put(folder / "a.txt", "old");
  const std::string message =
      expect_error(ErrorKind::existing_output, [&] { write_whole(folder / "a.txt", "new"); });
  EXPECT_NE(message.find("--overwrite"), std::string::npos) << message;
  EXPECT_EQ(bytes_of(folder / "a.txt"), "old");
  write_whole(folder / "a.txt", "new", true);
  EXPECT_EQ(bytes_of(folder / "a.txt"), "new");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WholeFile, AFileThatAppearsInTheMeantimeIsNotReplaced) {
  TemporaryFolder folder;
  WholeFile file(folder / "a.txt");
  file.write("ours");
  put(folder / "a.txt", "theirs");
  expect_error(ErrorKind::existing_output, [&] { file.commit(); });
  EXPECT_EQ(bytes_of(folder / "a.txt"), "theirs");
}

TEST(WholeFile, FollowsALinkAndKeepsPermissions) {
  TemporaryFolder folder;
  put(folder / "real.txt", "old");
  ::chmod((folder / "real.txt").c_str(), 0600);
  std::filesystem::create_symlink("real.txt", folder / "link.txt");
  write_whole(folder / "link.txt", "new", true);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
  EXPECT_EQ(bytes_of(folder / "real.txt"), "new");
  struct stat status {};
  ASSERT_EQ(::stat((folder / "real.txt").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0600u);
}

TEST(WholeFile, WhatCannotBeWrittenIsSaidBeforeTheWork) {
  TemporaryFolder folder;
  put(folder / "file", "");
  std::filesystem::create_directory(folder / "folder");
  const auto kind = ErrorKind::unwritable_output;
  expect_error(kind, [&] { WholeFile(folder / "nowhere/a.txt"); });
  expect_error(kind, [&] { WholeFile(folder / "file/a.txt"); });
  expect_error(kind, [&] { WholeFile("/proc/a.txt"); });  // closed to the superuser too
  expect_error(kind, [&] { WholeFile(folder / "folder", true); });
  expect_error(kind,
               [&] { WholeFile("/dev/null", true); });  // a rename would put a file in the device's place
  expect_error(kind, [&] { WholeFile(""); });
  EXPECT_EQ(folder.entries(), 2);
}

TEST(WholeFile, AFullDiskLeavesTheOldFile) {
  TemporaryFolder folder;
  put(folder / "a.txt", "old");
  {
    FullDisk full(1000);
    expect_error(ErrorKind::unwritable_output,
                 [&] { write_whole(folder / "a.txt", std::string(5000, 'x'), true); });
  }
  EXPECT_EQ(bytes_of(folder / "a.txt"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

}  // namespace
}  // namespace vegard::sim::whole_file_test
