// Classifies the sky in a frame by decision trees over its features; the scores of the trees are added. Each
// question has trees of its own, trained on frames with a known answer (scripts/learn_filter.py;
// data/filter/sky_trees.json names them).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fit/survey/filter/frame_features.h"

namespace vegard::fit {

/// What is asked of a frame. Several may be true of it at once.
enum class SkyQuestion { arc, twilight, cloud, moon, lamp, aurora };
inline constexpr int kSkyQuestions = 6;
/// "arc", "twilight", …; nothing for no question.
const char* sky_question_name(SkyQuestion question);

/// How likely each is, 0 to 1, among frames such as those that were learnt from.
using SkyScores = std::array<double, kSkyQuestions>;

/// A frame's class: "arc" if there is one to be fitted, whatever else there is; else the first of twilight,
/// cloud, moon, lamp, aurora (without an arc) that is likelier than not; else "dark".
std::string sky_class(const SkyScores& scores);
bool has_arc(const SkyScores& scores);

class SkyTrees {
 public:
  /// Of the text of a file. Throws sim::Error(unreadable_input), with its name, for what is no such file, or
  /// asks for a feature that there is not.
  SkyTrees(const std::string& text, const std::string& name);

  SkyScores scores(const FrameFeatures& features) const;

 private:
  struct Node {
    int feature = -1;        ///< -1: a leaf
    double threshold = 0.0;  ///< below it on to `below`, else to `above`
    int below = 0, above = 0;
    double score = 0.0;  ///< of a leaf: the sum over trees is the logarithm of the odds
  };
  using Tree = std::vector<Node>;
  static Tree tree_of(const std::string& json, const std::string& name);

  std::array<std::vector<Tree>, kSkyQuestions> trees_;
};

}  // namespace vegard::fit
