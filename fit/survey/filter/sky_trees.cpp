#include "fit/survey/filter/sky_trees.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/base/error.h"

namespace vegard::fit {
namespace {

constexpr double kLikelierThanNot = 0.5;
constexpr int kMaxNodes = 100000;

[[noreturn]] void refuse_trees(const std::string& file, const std::string& problem) {
  throw sim::Error(sim::ErrorKind::unreadable_input,
                   {problem, file, 0, {}, "what scripts/learn_filter.py writes", {}});
}

int feature_of(const std::string& name, const std::string& file) {
  for (const FeatureWords& words : feature_words())
    if (name == words.name) return static_cast<int>(words.feature);
  refuse_trees(file, "asks for a feature '" + name + "' that there is not");
}

}  // namespace

const char* sky_question_name(SkyQuestion question) {
  static constexpr std::array<const char*, kSkyQuestions> names = {"arc",  "twilight", "cloud",
                                                                   "moon", "lamp",     "aurora"};
  return names[static_cast<std::size_t>(question)];
}

bool has_arc(const SkyScores& scores) {
  return scores[static_cast<std::size_t>(SkyQuestion::arc)] > kLikelierThanNot;
}

std::string sky_class(const SkyScores& scores) {
  for (int question = 0; question < kSkyQuestions; ++question)
    if (scores[static_cast<std::size_t>(question)] > kLikelierThanNot)
      return sky_question_name(static_cast<SkyQuestion>(question));
  return "dark";
}

SkyTrees::Tree SkyTrees::tree_of(const std::string& text, const std::string& name) {
  const nlohmann::json nodes = nlohmann::json::parse(text);
  Tree tree;
  const auto count = static_cast<int>(nodes.size());
  if (!nodes.is_array() || count < 1 || count > kMaxNodes) refuse_trees(name, "has a tree of no nodes");
  for (const nlohmann::json& node : nodes) {
    Node one;
    if (node.contains("score")) {
      one.score = node.at("score").get<double>();
    } else {
      one.feature = feature_of(node.at("feature").get<std::string>(), name);
      one.threshold = node.at("threshold").get<double>();
      one.below = node.at("below").get<int>();
      one.above = node.at("above").get<int>();
      // Branches lead on, never back: every walk ends.
      const auto own = static_cast<int>(tree.size());
      if (one.below <= own || one.above <= own || one.below >= count || one.above >= count)
        refuse_trees(name, "has a branch that leads to no node behind it");
    }
    tree.push_back(one);
  }
  return tree;
}

SkyTrees::SkyTrees(const std::string& text, const std::string& name) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    if (json.at("kind") != "vegard sky trees" || json.at("format") != 1)
      refuse_trees(name, "has no trees of this version");
    for (int question = 0; question < kSkyQuestions; ++question)
      for (const nlohmann::json& nodes :
           json.at("trees").at(sky_question_name(static_cast<SkyQuestion>(question))))
        trees_[static_cast<std::size_t>(question)].push_back(tree_of(nodes.dump(), name));
  } catch (const nlohmann::json::exception&) {
    refuse_trees(name, "has no trees, or damaged ones");
  }
}

SkyScores SkyTrees::scores(const FrameFeatures& features) const {
  SkyScores scores{};
  for (std::size_t question = 0; question < trees_.size(); ++question) {
    double sum = 0.0;
    for (const Tree& tree : trees_[question]) {
      std::size_t at = 0;
      while (tree[at].feature >= 0) {
        const bool is_below = features[static_cast<std::size_t>(tree[at].feature)] < tree[at].threshold;
        at = static_cast<std::size_t>(is_below ? tree[at].below : tree[at].above);
      }
      sum += tree[at].score;
    }
    scores[question] = 1.0 / (1.0 + std::exp(-sum));
  }
  return scores;
}

}  // namespace vegard::fit
