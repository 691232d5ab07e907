// Models of the sky as files, and what they answer.
#include "fit/sky_kind/sky_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/expect_error.h"

namespace vegard::fit::sky_model_test {
namespace {

std::string question(const std::string& terms, const std::string& trees, const std::string& line) {
  const std::string weights = R"({"constant": 0.5, "terms": )" + terms + "}";
  return R"({"grey": )" + weights + R"(, "colour": )" + weights + ", " + line + R"(, "trees": )" + trees +
         "}";
}

constexpr const char* kLine =
    R"("line": {"slope": 1.0, "offset": 0.0}, "line_with_trees": {"slope": 1.0, "offset": 0.0})";
constexpr const char* kLines =
    R"("line": {"slope": 0.5, "offset": -1.0}, "line_with_trees": {"slope": 0.25, "offset": 1.0})";

std::string file_of(const std::string& arc) {
  return R"({"kind": "vegard sky kinds", "format": 2, "questions": {"arc": )" + arc + "}}";
}

constexpr const char* kTrees =
    R"([[{"score": 1.0}], [{"feature": "banded", "threshold": 0.5, "missing": "above", "below": 1, "above": 2},
  {"score": -3.0}, {"feature": "green", "threshold": 0.0, "missing": "below", "below": 3, "above": 4},
  {"score": 0.5}, {"score": 2.0}]])";
constexpr const char* kTerms =
    R"([{"feature": "contrast", "weight": 2.0, "least": 0.0, "most": 1.0, "missing": 0.25}])";

double likely(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

SkyFeatures no_features() {
  SkyFeatures features;
  features.fill(std::numeric_limits<double>::quiet_NaN());
  return features;
}

TEST(SkyModel, TreesOfKnownDirectionsAreWalkedFromTheirRootsAndAddUp) {
  const SkyModel model(file_of(question("[]", kTrees, kLine)), "model.json");
  SkyFeatures features = no_features();
  const auto arc = [&] { return score(model.scores(features), SkyQuestion::arc); };
  EXPECT_EQ(arc(), likely(0.5));  // no tree is asked without directions
  feature(features, SkyFeature::banded) = 0.4;
  EXPECT_EQ(arc(), likely(-1.5));
  feature(features, SkyFeature::banded) = 0.5;  // the threshold itself lies above
  EXPECT_EQ(arc(), likely(2.0));                // where a feature that there is not leads
  feature(features, SkyFeature::green) = 0.0;
  EXPECT_EQ(arc(), likely(3.5));
}

TEST(SkyModel, WeightsEndWhereWhatWasLearntFromEnds) {
  const SkyModel model(file_of(question(kTerms, "[]", kLines)), "model.json");
  SkyFeatures features = no_features();
  const auto arc = [&] { return score(model.scores(features), SkyQuestion::arc); };
  EXPECT_EQ(arc(), likely(0.5 * 0.75 - 1.0));
  feature(features, SkyFeature::contrast) = 0.5;
  EXPECT_EQ(arc(), likely(0.5 * 1.5 - 1.0));
  feature(features, SkyFeature::contrast) = 1e9;
  EXPECT_EQ(arc(), likely(0.5 * 2.5 - 1.0));
  const SkyModel with_tree(file_of(question(kTerms, R"([[{"score": 1.0}]])", kLines)), "model.json");
  feature(features, SkyFeature::banded) = 0.1;
  EXPECT_EQ(score(with_tree.scores(features), SkyQuestion::arc), likely(0.25 * 3.5 + 1.0));
}

TEST(SkyModel, QuestionsThatAFileLacksAreTheBuiltInModels) {
  const SkyModel model(file_of(question("[]", "[]", kLine)), "model.json");
  const SkyScores own = model.scores(no_features()), built_in = SkyModel::built_in().scores(no_features());
  EXPECT_EQ(score(own, SkyQuestion::arc), likely(0.5));
  EXPECT_EQ(score(own, SkyQuestion::moon), score(built_in, SkyQuestion::moon));
  for (const double probability : built_in) {
    EXPECT_GT(probability, 0.0);
    EXPECT_LT(probability, 1.0);
  }
}

TEST(SkyModel, WhatIsNoneIsRefused) {
  const auto words = [](const std::string& text) {
    return tests::expect_error(sim::ErrorKind::unreadable_input, [&] { SkyModel(text, "model.json"); });
  };
  const auto tree = [&](const std::string& nodes) {
    return words(file_of(question("[]", "[[" + nodes + R"(, {"score": 1}]])", kLine)));
  };
  EXPECT_NE(words("{").find("model.json"), std::string::npos);
  EXPECT_NE(words(R"({"kind": "other"})").find("no model"), std::string::npos);
  EXPECT_NE(words(R"({"kind": "vegard sky kinds", "format": 2, "questions": {}})").find("no question"),
            std::string::npos);
  // Of earlier versions.
  for (const char* old :
       {R"({"kind": "vegard sky trees", "format": 1})", R"({"kind": "vegard sky kinds", "format": 1})"})
    EXPECT_NE(words(old).find("another version"), std::string::npos);
  EXPECT_NE(words(file_of(question("[]", "[[]]", kLine))).find("no nodes"), std::string::npos);
  EXPECT_NE(tree(R"({"feature": "bandd", "threshold": 0, "missing": "below", "below": 1, "above": 1})")
                .find("'bandd'"),
            std::string::npos);
  // No walk goes in circles, or out of the tree.
  for (const char* below : {"0", "2", "-1"})
    EXPECT_NE(tree(std::string(R"({"feature": "banded", "threshold": 0, "missing": "below", "below": )") +
                   below + R"(, "above": 1})")
                  .find("branch"),
              std::string::npos);
  EXPECT_NE(tree(R"({"feature": "banded", "threshold": "x", "missing": "below", "below": 1, "above": 1})")
                .find("damaged"),
            std::string::npos);
  EXPECT_NE(
      words(file_of(question(R"([{"feature": "contrast", "weight": 1, "least": 2, "most": 1, "missing": 0}])",
                             "[]", kLine)))
          .find("range"),
      std::string::npos);
}

}  // namespace
}  // namespace vegard::fit::sky_model_test
