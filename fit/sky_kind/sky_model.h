// What features of a sky say of it: the probabilities of yes to a few questions, by a model that is learnt
// from skies of which the answer is known (scripts/learn_sky_kind.py).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fit/sky_kind/feature_weights.h"
#include "fit/sky_kind/sky_features.h"

namespace vegard::fit {

/// The questions: does the sky show an arc (or rays, a corona), twilight, ...? Several answers may be yes.
/// The last three are of skies with an arc.
enum class SkyQuestion { arc, twilight, cloud, moon, lamp, aurora, several, rayed, overhead };
inline constexpr int kSkyQuestions = 9;
/// Returns "arc", "twilight", …
const char* sky_question_name(SkyQuestion question);

/// The probability of each answer yes, 0 to 1.
using SkyScores = std::array<double, kSkyQuestions>;
inline double score(const SkyScores& scores, SkyQuestion question) {
  return scores[static_cast<std::size_t>(question)];
}

/// A model: each question's logarithm of the odds is a sum of weighted features, of grey and of coloured
/// pictures apart. Where the camera's directions are known the scores of decision trees are added (gradient
/// boosting, Friedman 2001), learnt from frames of such cameras. A line that was fitted to skies which the
/// model had not seen makes a probability of the sum (Platt 1999).
class SkyModel {
 public:
  /// Parses the text of a file. Questions that it does not answer are the built-in model's. Throws
  /// sim::Error(unreadable_input), with the file's name, if it is no such file, of an earlier format, or asks
  /// for an unknown feature.
  SkyModel(const std::string& text, const std::string& name);

  /// The model that is compiled in (data/filter/sky_kinds.json).
  static const SkyModel& built_in();

  SkyScores scores(const SkyFeatures& features) const;

 private:
  struct Node {
    int feature = -1;        ///< -1: a leaf
    double threshold = 0.0;  ///< a smaller feature leads to node `below`, others to node `above`
    int below = 0, above = 0;
    bool is_missing_below = false;  ///< where a feature leads that there is not
    double score = 0.0;             ///< of a leaf
  };
  using Tree = std::vector<Node>;
  /// From a sum to the logarithm of the odds.
  struct Line {
    double slope = 1.0, offset = 0.0;

    double probability(double sum) const;
  };
  struct Question {
    FeatureWeights grey, colour;
    Line line;
    std::vector<Tree> trees;
    Line line_with_trees;

    double answer(const SkyFeatures& features) const;
  };
  static Question question_of(const std::string& json, const std::string& name);
  static Tree tree_of(const std::string& json, const std::string& name);

  std::array<Question, kSkyQuestions> questions_;
};

}  // namespace vegard::fit
