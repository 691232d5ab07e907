#include "apps/preview/preview_pace.h"

#include <gtest/gtest.h>

namespace vegard::apps::preview_pace_test {
namespace {

/// A machine that takes so long for a whole picture at shrink 1.
int settle(PreviewPace& pace, double whole_ms, int* changes_of_the_last_half = nullptr) {
  for (int n = 0; n < 200; ++n) {
    const int shrink = pace.reduction().shrink;
    const bool changed = pace.take(whole_ms / (shrink * shrink));
    if (changed && n >= 100 && changes_of_the_last_half != nullptr) ++*changes_of_the_last_half;
  }
  return pace.reduction().shrink;
}

TEST(PreviewPace, FindsTheFinestThatKeepsTheRateAndStaysThere) {
  for (const double whole_ms : {5.0, 100.0, 180.0, 400.0, 1000.0}) {
    PreviewPace pace(sim::Reduction{}, 20.0);
    int changes = 0;
    const int shrink = settle(pace, whole_ms, &changes);
    EXPECT_LE(whole_ms / (shrink * shrink), 1.1 * 50.0) << whole_ms;
    EXPECT_EQ(changes, 0) << whole_ms << ": it goes to and fro";
  }
  PreviewPace quick(sim::Reduction{}, 20.0);
  EXPECT_EQ(settle(quick, 5.0), 1);
}

TEST(PreviewPace, GoesNoCoarserThanItsEndAndComesBack) {
  PreviewPace pace(sim::Reduction{}, 20.0);
  EXPECT_EQ(settle(pace, 1e6), 6);
  EXPECT_EQ(pace.reduction().points, 3e5);
  EXPECT_EQ(settle(pace, 1.0), 1);
  EXPECT_EQ(pace.reduction().points, sim::Reduction{}.points);
}

TEST(PreviewPace, DoesNotJudgeByOneSlowPicture) {
  PreviewPace pace(sim::Reduction{}, 20.0);
  for (int n = 0; n < 60; ++n) EXPECT_FALSE(pace.take(n % 10 == 3 ? 4000.0 : 30.0));
}

}  // namespace
}  // namespace vegard::apps::preview_pace_test
