#include "sim/base/file/durable_rename.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

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

}  // namespace
}  // namespace vegard::sim::durable_rename_test
