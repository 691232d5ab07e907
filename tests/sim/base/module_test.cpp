#include "sim/base/module.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <thread>
#include <vector>

#include "sim/base/picture/image_io/picture_codecs.h"

namespace vegard::sim::module_test {

TEST(Module, IsOneForAllThreads) {
  std::vector<const OpenImageIo*> found(4);
  std::vector<std::thread> threads;
  for (const OpenImageIo*& one : found)
    threads.emplace_back([&one] { one = &module_functions<OpenImageIo>(); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(std::set<const OpenImageIo*>(found.begin(), found.end()).size(), 1U);
  EXPECT_NE(found.front()->libraries().find("openexr:"), std::string::npos);
}

TEST(Module, SaysWhichFileIsMissingAndWhereItWasLookedFor) {
  for (int attempt = 0; attempt < 2; ++attempt) {
    try {
      module_table("vegard_no_such_module");
      FAIL() << "there is no such module";
    } catch (const MissingModule& missing) {
      const std::string words = missing.what();
      EXPECT_NE(words.find("vegard_no_such_module.so"), std::string::npos) << words;
      EXPECT_NE(words.find("/lib/vegard"), std::string::npos) << words;
    }
  }
}

}  // namespace vegard::sim::module_test
