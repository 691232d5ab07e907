
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>

#include "sim/base/file/durable_rename.h"
#include "sim/base/file/whole_directory.h"
#include "sim/base/file/whole_file.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::stale_partial_test {
namespace {

namespace fs = std::filesystem;
using tests::bytes_of;
using tests::put;
using tests::TemporaryFolder;

/// The number of a process that has just ended.
std::string dead_process() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  int status = 0;
  ::waitpid(child, &status, 0);
  return std::to_string(child);
}

DirectoryKind kind() {
  return {"a run",
          [](const std::string&) {
            return KnownFolder{"", [](const std::string& name) { return name == "result.json"; }};
          },
          {"result.json"}};
}

TEST(StalePartial, OfADeadProcessIsRemovedByTheNextOfTheSameOutput) {
  TemporaryFolder folder;
  const std::string dead = dead_process();
  put(folder / (".a.partial-" + dead + "-0.exr"), "half");
  put(folder / (".a.partial-" + dead + "-7.exr"), "half");
  // Of other outputs, of no such form, of a living process, and what is no file.
  put(folder / (".b.partial-" + dead + "-0.exr"), "half");
  put(folder / (".a.partial-" + dead + "-0.png"), "half");
  put(folder / (".a.partial-" + dead + "-0.exr.bak"), "mine");
  put(folder / ("a.partial-" + dead + "-0.exr"), "mine");
  put(folder / (".a.partial-" + std::to_string(::getpid()) + "-5.exr"), "at work");
  put(folder / "elsewhere", "mine");
  fs::create_symlink(folder / "elsewhere", folder / (".a.partial-" + dead + "-2.exr"));
  fs::create_directory(folder / (".a.partial-" + dead + "-3.exr"));
  {
    WholeFile file(folder / "a.exr");
    EXPECT_EQ(folder.entries(), 9);  // with the new one
  }
  EXPECT_EQ(folder.entries(), 8);
  EXPECT_FALSE(fs::exists(folder / (".a.partial-" + dead + "-0.exr")));
  EXPECT_FALSE(fs::exists(folder / (".a.partial-" + dead + "-7.exr")));
  EXPECT_EQ(bytes_of(folder / "elsewhere"), "mine");
}

// The number of a process says nothing of another machine, or of another container, that writes there.
TEST(StalePartial, WhatIsLockedHasAnOwner) {
  TemporaryFolder folder;
  const std::string path = folder / (".a.partial-" + dead_process() + "-0.exr");
  put(path, "at work");
  PartialLock lock(::open(path.c_str(), O_RDONLY));
  EXPECT_FALSE(is_stale_partial(path, S_IFREG));
  lock.release();
  EXPECT_TRUE(is_stale_partial(path, S_IFREG));
}

// In a container every first process has the same number.
TEST(StalePartial, ANumberThatAnotherProcessHasByNowIsNoOwner) {
  TemporaryFolder folder;
  const std::string path = folder / (".a.partial-" + std::to_string(::getpid()) + "-0.exr");
  put(path, "half");
  EXPECT_FALSE(is_stale_partial(path, S_IFREG));
  const std::array<timespec, 2> long_ago = {{{1000000000, 0}, {1000000000, 0}}};
  ASSERT_EQ(::utimensat(AT_FDCWD, path.c_str(), long_ago.data(), 0), 0);
  EXPECT_TRUE(is_stale_partial(path, S_IFREG));
}

TEST(StalePartial, TwoAtOnceDoNotDisturbEachOther) {
  TemporaryFolder folder;
  WholeFile first(folder / "a.txt");
  const std::array<timespec, 2> long_ago = {{{1000000000, 0}, {1000000000, 0}}};
  ASSERT_EQ(::utimensat(AT_FDCWD, first.temporary().c_str(), long_ago.data(), 0), 0);
  WholeFile second(folder / "a.txt", true);
  first.write("first");
  second.write("second");
  first.commit();
  second.commit();
  EXPECT_EQ(bytes_of(folder / "a.txt"), "second");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(StalePartial, AFolderIsEmptiedOfWhatIsKnownAlone) {
  TemporaryFolder folder;
  const std::string dead = dead_process();
  const std::string half = folder / (".run.partial-" + dead + "-0");
  fs::create_directory(half);
  put(half + "/result.json", "old");
  put(half + "/.best.partial-" + dead + "-0.toml", "half");
  put(half + "/thesis.tex", "years");
  { WholeDirectory run(folder / "run", false, kind()); }
  EXPECT_EQ(bytes_of(half + "/thesis.tex"), "years");
  EXPECT_FALSE(fs::exists(half + "/result.json"));
  fs::remove(half + "/thesis.tex");
  put(half + "/result.json", "old");
  { WholeDirectory run(folder / "run", false, kind()); }
  EXPECT_EQ(folder.entries(), 0);
}

}  // namespace
}  // namespace vegard::sim::stale_partial_test
