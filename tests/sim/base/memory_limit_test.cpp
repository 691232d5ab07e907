#include "sim/base/memory_limit.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace vegard::sim::memory_limit_test {
namespace {

TEST(MemoryLimit, RefusesMoreThanThatAndSaysHowMuch) {
  constexpr double kGiga = 1024.0 * 1024.0 * 1024.0;
  EXPECT_NO_THROW(require_memory({2.0 * kGiga, true, "--memory-limit"}, 2.0 * kGiga, "it", ""));
  const std::string given = tests::expect_error(ErrorKind::usage, [&] {
    require_memory({2.0 * kGiga, true, "--memory-limit"}, 3.0 * kGiga, "a picture", "smaller ones need less");
  });
  EXPECT_TRUE(tests::has_facts(given, "--memory-limit | a picture | 3 GB | 2 GB | smaller ones need less"));
  const std::string free = tests::expect_error(ErrorKind::usage, [&] {
    require_memory({2.0 * kGiga, false, "render"}, 3.0 * kGiga, "a picture", "");
  });
  EXPECT_NE(free.find("what is free"), std::string::npos) << free;
}

TEST(MemoryLimit, IsSomethingOnAMachineThatTells) { EXPECT_GT(usable_memory_bytes(), 1e6); }

}  // namespace
}  // namespace vegard::sim::memory_limit_test
