#include "sim/base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace vegard::sim::parallel_test {
namespace {

TEST(ThreadCount, IsWhatWasAskedForUpToTheCores) {
  const int cores = thread_count(0);
  EXPECT_GE(cores, 1);
  EXPECT_LE(cores, static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  EXPECT_EQ(thread_count(1), 1);
  EXPECT_EQ(thread_count(cores + 1), cores);
  EXPECT_EQ(thread_count(1024), cores);
}

TEST(ParallelFor, CallsEveryIndexOnceWithASlotOfItsOwn) {
  for (int threads : {0, 1, 2, 3, 64}) {
    std::vector<std::atomic<int>> calls(1000), busy(thread_count(threads));
    std::atomic<bool> shared{false};
    parallel_for(calls.size(), threads, [&](std::size_t i, int slot) {
      if (slot < 0 || slot >= thread_count(threads) || busy[slot].fetch_add(1) != 0) {
        shared = true;
        return;
      }
      ++calls[i];
      --busy[slot];
    });
    EXPECT_FALSE(shared) << threads;
    for (const auto& n : calls) ASSERT_EQ(n, 1) << threads;
  }
}

TEST(ParallelFor, SaysNothingWhenAskedForMoreThreadsThanCores) {
  ::testing::internal::CaptureStderr();
  parallel_for(1000, 4096, [](std::size_t, int) {});
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace vegard::sim::parallel_test
