#include "fit/survey/filter/frame_filter.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include "sim/base/data_folders.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kMaxTreesBytes = 16 << 20;
constexpr const char* kBuiltIn = "sky_trees.json";

std::string text_of_trees(const std::string& file) {
  return file.empty() ? std::string(sim::embedded_table(kBuiltIn))
                      : sim::input_bytes(file, "trees of a filter (JSON)", kMaxTreesBytes);
}

/// Returns a flag for each pixel: 0 under the mask.
std::vector<std::uint8_t> kept_by(const std::string& mask, const sim::Camera& camera) {
  if (mask.empty()) return {};
  Photo blank;
  blank.linear = sim::Image(camera.width, camera.height, {"R", "G", "B"});
  blank.usable.assign(blank.linear.data.size(), 1);
  apply_mask(blank, mask);
  std::vector<std::uint8_t> kept(blank.usable.size() / 3);
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = blank.usable[3 * i];
  return kept;
}

constexpr double kLikelierThanNot = 0.5;
constexpr int kMaxNodes = 100000;

sim::Error bad_trees(const std::string& file, const std::string& problem) {
  return sim::unreadable(file, problem).expected("what scripts/learn_filter.py writes");
}

int feature_of(const std::string& name, const std::string& file) {
  for (const FeatureWords& words : feature_words())
    if (name == words.name) return static_cast<int>(words.feature);
  throw bad_trees(file, "asks for a feature '" + name + "' that there is not");
}

}  // namespace

FrameFilter::FrameFilter(const sim::Scene& scene, const std::string& mask, const std::string& trees)
    : cells_(filter_cells(scene, kept_by(mask, scene.camera))),
      trees_(text_of_trees(trees), trees.empty() ? kBuiltIn : trees),
      sha256_(sim::sha256(text_of_trees(trees))) {}

FilterFinding FrameFilter::classify(const Photo& photo, const sim::Scene& scene, double utc_s) const {
  FilterFinding found;
  found.features = frame_features(photo, scene, cells_, utc_s);
  found.scores = trees_.scores(found.features);
  found.sky = sky_class(found.scores);
  return found;
}

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
  if (!nodes.is_array() || count < 1 || count > kMaxNodes) throw bad_trees(name, "has a tree of no nodes");
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
        throw bad_trees(name, "has a branch that leads to no node behind it");
    }
    tree.push_back(one);
  }
  return tree;
}

SkyTrees::SkyTrees(const std::string& text, const std::string& name) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    if (json.at("kind") != "vegard sky trees" || json.at("format") != 1)
      throw bad_trees(name, "has no trees of this version");
    for (int question = 0; question < kSkyQuestions; ++question)
      for (const nlohmann::json& nodes :
           json.at("trees").at(sky_question_name(static_cast<SkyQuestion>(question))))
        trees_[static_cast<std::size_t>(question)].push_back(tree_of(nodes.dump(), name));
  } catch (const nlohmann::json::exception&) {
    throw bad_trees(name, "has no trees, or damaged ones");
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
