// What is left to do goes by the pace since the work began here, not by what another process has done.
#include "apps/output/progress_bar.h"

#include <gtest/gtest.h>

namespace vegard::apps::progress_bar_test {
namespace {

TEST(SecondsToGo, GoByThePaceSinceAPoint) {
  // A quarter in 10 s: three quarters are left, at the same pace.
  EXPECT_DOUBLE_EQ(*seconds_to_go({0.0, 0.0}, {0.25, 10.0}), 30.0);
  // Resumed at 60 %: a fifth of the whole in 10 s, so that the last fifth takes 10 s.
  EXPECT_NEAR(*seconds_to_go({0.6, 1.0}, {0.8, 11.0}), 10.0, 1e-9);
  EXPECT_DOUBLE_EQ(*seconds_to_go({0.0, 0.0}, {1.0, 7.0}), 0.0);
}

TEST(SecondsToGo, AreUnknownAtFirst) {
  EXPECT_FALSE(seconds_to_go({0.0, 0.0}, {0.0, 5.0}));
  EXPECT_FALSE(seconds_to_go({0.6, 1.0}, {0.61, 3.0}));
}

TEST(ProgressLine, HasTheTimeGoneAndToGoWithinItsColumns) {
  const std::string line = progress_line("polish", {0.5, 100.0}, 200.0, 60);
  EXPECT_NE(line.find("50 %, 1 min 40 s, 3 min 20 s to go"), std::string::npos) << line;
  EXPECT_LT(line.size(), 60u);
  EXPECT_EQ(progress_line("polish", {0.5, 100.0}, {}, 60).find("to go"), std::string::npos);
  EXPECT_LT(progress_line("a label as long as a line", {0.5, 100.0}, 200.0, 30).size(), 30u);
}

TEST(ProgressLine, IsNeverFullWhileItShows) {
  for (const double share : {0.995, 1.0, 2.0}) {
    const std::string line = progress_line("writing", {share, 100.0}, {}, 60);
    EXPECT_NE(line.find(" 99 %"), std::string::npos) << line;
    EXPECT_EQ(line.find("100 %"), std::string::npos) << line;
  }
}

}  // namespace
}  // namespace vegard::apps::progress_bar_test
