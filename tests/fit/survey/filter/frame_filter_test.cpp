// A frame's class by the answers of the model.
#include "fit/survey/filter/frame_filter.h"

#include <gtest/gtest.h>

namespace vegard::fit::frame_filter_test {
namespace {

TEST(FrameFilter, PutsAnArcBeforeAllElse) {
  SkyScores scores{};
  const auto set = [&](SkyQuestion question, double probability) {
    scores[static_cast<std::size_t>(question)] = probability;
  };
  EXPECT_EQ(sky_class(scores), "dark");
  set(SkyQuestion::aurora, 0.9);
  EXPECT_EQ(sky_class(scores), "aurora");
  set(SkyQuestion::cloud, 0.6);
  EXPECT_EQ(sky_class(scores), "cloud");
  // Kinds of arcs are no classes of frames.
  set(SkyQuestion::rayed, 1.0);
  EXPECT_EQ(sky_class(scores), "cloud");
  EXPECT_FALSE(has_arc(scores));
  set(SkyQuestion::arc, 0.51);
  EXPECT_EQ(sky_class(scores), "arc");
  EXPECT_TRUE(has_arc(scores));
}

}  // namespace
}  // namespace vegard::fit::frame_filter_test
