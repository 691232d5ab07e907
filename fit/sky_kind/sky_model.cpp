#include "fit/sky_kind/sky_model.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "sim/base/data_folders.h"
#include "sim/base/error.h"

namespace vegard::fit {
namespace sky_model {
namespace {

constexpr const char* kBuiltIn = "sky_kinds.json";
constexpr int kMaxNodes = 100000;

void check_kind(const nlohmann::json& json, const std::string& name) {
  constexpr int kFormat = 2;
  const std::string kind = json.at("kind").get<std::string>();
  if (kind == "vegard sky trees" || (kind == "vegard sky kinds" && json.at("format") != kFormat))
    throw bad_sky_model(name, "is a model of the sky of another version")
        .hint("learn it anew of the same marks (docs/surveys.md, \"The filter\")");
  if (kind != "vegard sky kinds") throw bad_sky_model(name, "is no model of the sky");
}

}  // namespace
}  // namespace sky_model

const char* sky_question_name(SkyQuestion question) {
  static constexpr std::array<const char*, kSkyQuestions> names = {
      "arc", "twilight", "cloud", "moon", "lamp", "aurora", "several", "rayed", "overhead"};
  return names[static_cast<std::size_t>(question)];
}

double SkyModel::Line::probability(double sum) const {
  return 1.0 / (1.0 + std::exp(-(slope * sum + offset)));
}

double SkyModel::Question::answer(const SkyFeatures& features) const {
  const FeatureWeights& weights = std::isnan(feature(features, SkyFeature::green_spread)) ? grey : colour;
  double sum = weights.sum(features);
  const bool knows_directions = !std::isnan(feature(features, SkyFeature::banded));
  if (!knows_directions || trees.empty()) return line.probability(sum);
  for (const Tree& tree : trees) {
    std::size_t at = 0;
    while (tree[at].feature >= 0) {
      const double value = features[static_cast<std::size_t>(tree[at].feature)];
      const bool is_below = std::isnan(value) ? tree[at].is_missing_below : value < tree[at].threshold;
      at = static_cast<std::size_t>(is_below ? tree[at].below : tree[at].above);
    }
    sum += tree[at].score;
  }
  return line_with_trees.probability(sum);
}

SkyModel::Tree SkyModel::tree_of(const std::string& text, const std::string& name) {
  const nlohmann::json nodes = nlohmann::json::parse(text);
  Tree tree;
  const auto count = static_cast<int>(nodes.size());
  if (!nodes.is_array() || count < 1 || count > sky_model::kMaxNodes)
    throw bad_sky_model(name, "has a tree of no nodes");
  for (const nlohmann::json& node : nodes) {
    Node one;
    if (node.contains("score")) {
      one.score = node.at("score").get<double>();
    } else {
      one.feature = feature_number(node.at("feature").get<std::string>(), name);
      one.threshold = node.at("threshold").get<double>();
      one.below = node.at("below").get<int>();
      one.above = node.at("above").get<int>();
      one.is_missing_below = node.at("missing").get<std::string>() == "below";
      // Branches lead on, never back: every walk ends.
      const auto own = static_cast<int>(tree.size());
      if (one.below <= own || one.above <= own || one.below >= count || one.above >= count)
        throw bad_sky_model(name, "has a branch that leads to no node behind it");
    }
    tree.push_back(one);
  }
  return tree;
}

SkyModel::Question SkyModel::question_of(const std::string& text, const std::string& name) {
  const nlohmann::json json = nlohmann::json::parse(text);
  Question question;
  question.grey = feature_weights(json.at("grey").dump(), name);
  question.colour = feature_weights(json.at("colour").dump(), name);
  const auto line = [&](const char* key) {
    return Line{json.at(key).at("slope").get<double>(), json.at(key).at("offset").get<double>()};
  };
  question.line = line("line");
  question.line_with_trees = line("line_with_trees");
  for (const nlohmann::json& nodes : json.at("trees")) question.trees.push_back(tree_of(nodes.dump(), name));
  return question;
}

SkyModel::SkyModel(const std::string& text, const std::string& name) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    sky_model::check_kind(json, name);
    const nlohmann::json& questions = json.at("questions");
    if (!questions.is_object() || questions.empty()) throw bad_sky_model(name, "answers no question");
    for (int q = 0; q < kSkyQuestions; ++q) {
      const char* const word = sky_question_name(static_cast<SkyQuestion>(q));
      const auto at = static_cast<std::size_t>(q);
      if (questions.contains(word)) {
        questions_[at] = question_of(questions.at(word).dump(), name);
      } else if (name != sky_model::kBuiltIn) {
        questions_[at] = built_in().questions_[at];
      }
    }
  } catch (const nlohmann::json::exception&) {
    throw bad_sky_model(name, "is no model of the sky, or a damaged one");
  }
}

const SkyModel& SkyModel::built_in() {
  static const SkyModel model(std::string(sim::embedded_table(sky_model::kBuiltIn)), sky_model::kBuiltIn);
  return model;
}

SkyScores SkyModel::scores(const SkyFeatures& features) const {
  SkyScores scores{};
  for (std::size_t q = 0; q < scores.size(); ++q) scores[q] = questions_[q].answer(features);
  return scores;
}

}  // namespace vegard::fit
