
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sim/base/memory_limit.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::available_memory_test {
namespace {

constexpr std::uint64_t kMega = std::uint64_t{1} << 20;

/// A machine's files in a folder.
class Machine {
 public:
  Machine() { put("proc/meminfo", "MemTotal:       8388608 kB\nMemAvailable:   4194304 kB\n"); }
  void put(const std::string& name, const std::string& text) {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  std::uint64_t left() const { return available_memory(folder_ / ""); }

 private:
  tests::TemporaryFolder folder_;
};

TEST(AvailableMemory, IsWhatTheMachineHasLeft) {
  EXPECT_EQ(Machine().left(), 4096 * kMega);
  EXPECT_GT(available_memory(), 0u);
}

TEST(AvailableMemory, AControlGroupMayLeaveLess) {
  Machine machine;
  machine.put("proc/self/cgroup", "0::/user/job\n");
  machine.put("sys/fs/cgroup/user/job/memory.max", "max\n");
  EXPECT_EQ(machine.left(), 4096 * kMega);
  machine.put("sys/fs/cgroup/user/job/memory.max", std::to_string(1000 * kMega) + "\n");
  machine.put("sys/fs/cgroup/user/job/memory.current", std::to_string(700 * kMega) + "\n");
  EXPECT_EQ(machine.left(), 300 * kMega);
  // Pages of files give way.
  machine.put("sys/fs/cgroup/user/job/memory.stat",
              "anon 5\ninactive_file " + std::to_string(200 * kMega) + "\n");
  EXPECT_EQ(machine.left(), 500 * kMega);
  // So may one above it.
  machine.put("sys/fs/cgroup/user/memory.max", std::to_string(100 * kMega) + "\n");
  EXPECT_EQ(machine.left(), 100 * kMega);
  machine.put("sys/fs/cgroup/user/memory.current", std::to_string(101 * kMega) + "\n");
  EXPECT_EQ(machine.left(), 0u);
}

TEST(AvailableMemory, OfTheFirstVersionToo) {
  Machine machine;
  machine.put("proc/self/cgroup", "3:cpu,cpuacct:/\n4:memory:/job\n0::/\n");
  machine.put("sys/fs/cgroup/memory/job/memory.limit_in_bytes", std::to_string(900 * kMega) + "\n");
  machine.put("sys/fs/cgroup/memory/job/memory.usage_in_bytes", std::to_string(300 * kMega) + "\n");
  EXPECT_EQ(machine.left(), 600 * kMega);
}

TEST(AvailableMemory, IsUnknownWhereNothingGivesIt) {
  const tests::TemporaryFolder folder;
  EXPECT_EQ(available_memory(folder / "nowhere"), 0u);
}

TEST(MemoryText, HasThreeDigits) {
  EXPECT_EQ(memory_text(5e8), "477 MB");
  EXPECT_EQ(memory_text(4.0 * 1024 * kMega), "4 GB");
  EXPECT_EQ(memory_text(381.4 * 1024 * kMega), "381 GB");
  EXPECT_EQ(memory_text(4e15), "3725290 GB");
}

}  // namespace
}  // namespace vegard::sim::available_memory_test
