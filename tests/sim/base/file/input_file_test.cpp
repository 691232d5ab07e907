#include "sim/base/file/input_file.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <string>

#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::input_file_test {
namespace {

namespace fs = std::filesystem;
using tests::put;
using tests::TemporaryFolder;

TEST(InputFile, IsReadWhole) {
  TemporaryFolder folder;
  const std::string bytes = std::string("a\0b\n", 4) + std::string(200000, 'x');
  put(folder / "file", bytes);
  put(folder / "empty", "");
  fs::create_symlink(folder / "file", folder / "link");
  for (const char* name : {"file", "link"}) {
    const InputFile file = read_input(folder / name);
    EXPECT_TRUE(file.bytes == bytes) << name;
    EXPECT_EQ(file.problem, "") << name;
    EXPECT_EQ(why_no_input(folder / name), "") << name;
  }
  EXPECT_EQ(read_input(folder / "empty").problem, "");
  EXPECT_EQ(read_beginning(folder / "file", 3).bytes, bytes.substr(0, 3));
}

TEST(InputFile, IsReadUpToALimitThatIsSaid) {
  TemporaryFolder folder;
  put(folder / "file", std::string(2048, 'x'));
  EXPECT_EQ(read_input(folder / "file", 2048).bytes.size(), 2048U);
  const InputFile refused = read_input(folder / "file", 2047);
  EXPECT_EQ(refused.problem, "is larger than 1 kB");
  EXPECT_TRUE(refused.bytes.empty());
  // It says that it is empty, and is not.
  EXPECT_TRUE(tests::has_facts(read_input("/proc/self/status", 10).problem, "10 bytes"));
}

// Each of these would wait, or go on, for ever.
TEST(InputFile, OnlyRegularFilesAreRead) {
  TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", folder / "device");
  fs::create_directory(folder / "folder");
  const int descriptor = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_GE(descriptor, 0);
  struct sockaddr_un address {};
  address.sun_family = AF_UNIX;
  const fs::path before = fs::current_path();
  fs::current_path(folder / "");  // the address has room for a short name alone
  std::strcpy(address.sun_path, "socket");
  ASSERT_EQ(::bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  fs::current_path(before);
  const auto why = [&](const char* name) {
    const std::string problem = read_input(folder / name).problem;
    EXPECT_EQ(why_no_input(folder / name), problem) << name;
    return problem;
  };
  EXPECT_TRUE(tests::has_facts(why("pipe"), "is a pipe"));
  EXPECT_TRUE(tests::has_facts(why("device"), "is a device"));
  EXPECT_EQ(why("folder"), "is a directory");
  EXPECT_TRUE(tests::has_facts(why("socket"), "is a socket"));
  EXPECT_TRUE(tests::has_facts(why("nowhere"), "no such file"));
  ::close(descriptor);
  const std::string message = tests::expect_error(ErrorKind::unreadable_input,
                                                  [&] { input_bytes(folder / "pipe", "table of stars"); });
  EXPECT_TRUE(tests::has_facts(message, "pipe: | is a pipe | table of stars")) << message;
}

}  // namespace
}  // namespace vegard::sim::input_file_test
