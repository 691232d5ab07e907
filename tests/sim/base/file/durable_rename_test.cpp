#include "sim/base/file/durable_rename.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <thread>
#include <utility>

#include "sim/base/file/whole_file.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::durable_rename_test {
namespace {

TEST(PartialName, CanBeReadBack) {
  for (const char* target : {"a_0001.png", "a.b.exr", ".hidden.png", "folder"}) {
    const auto partial = partial_of(std::filesystem::path(partial_name(target, 12)).filename().string());
    ASSERT_TRUE(partial) << target;
    EXPECT_EQ(partial->target, target);
    EXPECT_EQ(partial->process, ::getpid());
    EXPECT_TRUE(is_alive(partial->process));
  }
  for (const char* other :
       {"a.partial-1-0.png", ".a.partial--0.png", ".a.partial-1.png", ".a.partial-0-0.png",
        ".a.partial-1-0.png.bak", ".partial-1-0.png", ".a.partial-9999999999-0.png", ""})
    EXPECT_FALSE(partial_of(other)) << other;
}

namespace fs = std::filesystem;

/// Begins files without end and gives them up, which waits for no disk, and tells of the first by `begun`.
[[noreturn]] void begin_for_ever(const std::string& name, int begun) {
  for (bool is_first = true;; is_first = false) {
    const WholeFile file(name, true);
    if (is_first) static_cast<void>(::write(begun, "1", 1) == 1);
  }
}

void end_at_once(int /*signal*/) {
  delete_unfinished_files();
  ::_exit(42);
}

/// Forks a process that begins files, in its first thread and in another one, and ends it by a signal a while
/// after both have begun one. Returns its exit status, and the names that stay behind.
std::pair<int, std::string> left_behind(const fs::path& folder, useconds_t after_us) {
  const auto former =
      ::signal(SIGTERM, end_at_once);  // here: the signal may come before the child does a thing
  int begun[2] = {-1, -1};
  EXPECT_EQ(::pipe(begun), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    std::thread([&] { begin_for_ever((folder / "b").string(), begun[1]); }).detach();
    begin_for_ever((folder / "a").string(), begun[1]);
  }
  ::signal(SIGTERM, former);
  ::close(begun[1]);
  char one;
  for (int told = 0; told < 2 && ::read(begun[0], &one, 1) == 1;) ++told;
  ::close(begun[0]);
  ::usleep(after_us);
  ::kill(child, SIGTERM);
  int status = 0;
  ::waitpid(child, &status, 0);
  std::string names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (partial_of(entry.path().filename().string())) names += entry.path().filename().string() + "\n";
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, names};
}

// However the signal falls, in the thread that creates a file or in another one.
TEST(UnfinishedFiles, AreAllDeletedByASignal) {
  const tests::TemporaryFolder folder;
  for (int round = 0; round < 50; ++round)
    ASSERT_EQ(left_behind(folder / "", static_cast<useconds_t>(37 * round)),
              std::make_pair(42, std::string()))
        << "round " << round;
}

}  // namespace
}  // namespace vegard::sim::durable_rename_test
