#include "sim/base/file/durable_rename.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <thread>
#include <utility>

#include "sim/base/error.h"
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

/// Writes files without end, and never finishes one in four of them.
[[noreturn]] void write_for_ever(const fs::path& folder, const std::string& stem) {
  for (int number = 0;; ++number) {
    const std::string name = (folder / (stem + std::to_string(number % 4))).string();
    try {
      WholeFile file(name, true);
      file.write("whole");
      if (number % 4 != 0) file.commit();
    } catch (const Error&) {  // what the handler has deleted cannot be finished
      for (;;) ::pause();
    }
  }
}

void end_at_once(int /*signal*/) {
  delete_unfinished_files();
  ::_exit(42);
}

/// Forks a process that writes, in its first thread and in another one, and ends it by a signal after a
/// while. Returns its exit status, and the names that stay behind and are no finished output.
std::pair<int, std::string> left_behind(const fs::path& folder, useconds_t after_us) {
  const auto former =
      ::signal(SIGTERM, end_at_once);  // here: the signal may come before the child does a thing
  const pid_t child = ::fork();
  if (child == 0) {
    std::thread([&] { write_for_ever(folder, "b"); }).detach();
    write_for_ever(folder, "a");
  }
  ::signal(SIGTERM, former);
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
    ASSERT_EQ(left_behind(folder / "", static_cast<useconds_t>(500 + 37 * round)),
              std::make_pair(42, std::string()))
        << "round " << round;
}

}  // namespace
}  // namespace vegard::sim::durable_rename_test
