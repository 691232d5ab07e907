// Trees as files, and what they answer.
#include "fit/survey/filter/frame_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/data_folders.h"
#include "tests/support/expect_error.h"

namespace vegard::fit::sky_trees_test {
namespace {

std::string file_of(const std::string& arc) {
  std::string text = R"({"kind": "vegard sky trees", "format": 1, "trees": {"arc": )" + arc;
  for (const char* question : {"twilight", "cloud", "moon", "lamp", "aurora"})
    text += std::string(", \"") + question + R"(": [[{"score": -1.5}]])";
  return text + "}}";
}

constexpr const char* kArc =
    R"([[{"score": 1.0}], [{"feature": "banded", "threshold": 0.5, "below": 1, "above": 2}, {"score": -3.0},
  {"feature": "green", "threshold": 0.0, "below": 3, "above": 4}, {"score": 0.5}, {"score": 2.0}]])";

double likely(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

TEST(SkyTrees, AreWalkedFromTheirRootsAndAddUp) {
  const SkyTrees trees(file_of(kArc), "trees.json");
  FrameFeatures features{};
  const auto arc = [&] { return trees.scores(features)[static_cast<std::size_t>(SkyQuestion::arc)]; };
  EXPECT_EQ(arc(), likely(-2.0));
  feature(features, FrameFeature::banded) = 0.5;  // the threshold itself lies above
  EXPECT_EQ(arc(), likely(3.0));
  feature(features, FrameFeature::green) = -0.1;
  EXPECT_EQ(arc(), likely(1.5));
  EXPECT_EQ(trees.scores(features)[1], likely(-1.5));
}

TEST(SkyTrees, PutAnArcBeforeAllElse) {
  SkyScores scores{};
  EXPECT_EQ(sky_class(scores), "dark");
  scores[static_cast<std::size_t>(SkyQuestion::aurora)] = 0.9;
  EXPECT_EQ(sky_class(scores), "aurora");
  scores[static_cast<std::size_t>(SkyQuestion::cloud)] = 0.6;
  EXPECT_EQ(sky_class(scores), "cloud");
  EXPECT_FALSE(has_arc(scores));
  scores[static_cast<std::size_t>(SkyQuestion::arc)] = 0.51;
  EXPECT_EQ(sky_class(scores), "arc");
  EXPECT_TRUE(has_arc(scores));
}

TEST(SkyTrees, ThatAreNoneAreRefused) {
  const auto words = [](const std::string& text) {
    return tests::expect_error(sim::ErrorKind::unreadable_input, [&] { SkyTrees(text, "trees.json"); });
  };
  EXPECT_NE(words("{").find("trees.json"), std::string::npos);
  EXPECT_NE(words(R"({"kind": "other"})").find("of this version"), std::string::npos);
  EXPECT_NE(words(file_of("[[]]")).find("no nodes"), std::string::npos);
  EXPECT_NE(
      words(file_of(R"([[{"feature": "bandd", "threshold": 0, "below": 1, "above": 1}, {"score": 1}]])"))
          .find("'bandd'"),
      std::string::npos);
  // No walk goes in circles, or out of the tree.
  for (const char* below : {"0", "2", "-1"})
    EXPECT_NE(words(file_of(std::string(R"([[{"feature": "banded", "threshold": 0, "below": )") + below +
                            R"(, "above": 1}, {"score": 1}]])"))
                  .find("branch"),
              std::string::npos);
  EXPECT_NE(
      words(file_of(R"([[{"feature": "banded", "threshold": "x", "below": 1, "above": 1}, {"score": 1}]])"))
          .find("damaged"),
      std::string::npos);
}

TEST(SkyTrees, OfTheLibraryCanBeRead) {
  EXPECT_NO_THROW(SkyTrees(std::string(sim::embedded_table("sky_trees.json")), "sky_trees.json"));
}

}  // namespace
}  // namespace vegard::fit::sky_trees_test
