// Decides whether a frame has an arc that is worth a fit, and what else it shows.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fit/survey/filter/frame_features.h"

namespace vegard::fit {

// Classifies the sky in a frame by decision trees over its features; the scores of the trees are added. Each
// question has its own trees, trained on frames with a known answer (scripts/learn_filter.py;
// data/filter/sky_trees.json lists these frames).

/// The questions about a frame: does it show an arc, twilight, ...? Several answers may be yes.
enum class SkyQuestion { arc, twilight, cloud, moon, lamp, aurora };
inline constexpr int kSkyQuestions = 6;
/// Returns "arc", "twilight", …
const char* sky_question_name(SkyQuestion question);

/// The probability of each answer yes, 0 to 1, for frames like those of the training.
using SkyScores = std::array<double, kSkyQuestions>;

/// A frame's class: "arc" if there is one to be fitted, whatever else there is; else the first of twilight,
/// cloud, moon, lamp, aurora (without an arc) that is likelier than not; else "dark".
std::string sky_class(const SkyScores& scores);
bool has_arc(const SkyScores& scores);

class SkyTrees {
 public:
  /// Parses the text of a file. Throws sim::Error(unreadable_input), with the file's name, if it is not a
  /// file of trees, or uses an unknown feature.
  SkyTrees(const std::string& text, const std::string& name);

  SkyScores scores(const FrameFeatures& features) const;

 private:
  struct Node {
    int feature = -1;        ///< -1: a leaf
    double threshold = 0.0;  ///< a smaller feature leads to node `below`, others to node `above`
    int below = 0, above = 0;
    double score = 0.0;  ///< of a leaf; the sum over all trees is the logarithm of the odds
  };
  using Tree = std::vector<Node>;
  static Tree tree_of(const std::string& json, const std::string& name);

  std::array<std::vector<Tree>, kSkyQuestions> trees_;
};

struct FilterFinding {
  FrameFeatures features{};
  SkyScores scores{};
  std::string sky;  ///< the frame's class, from sky_class()
};

/// The filter for one camera during one of its calibrations.
class FrameFilter {
 public:
  /// `mask`, `trees`: names with which the files can be opened; empty: no mask; the built-in trees. Throws
  /// sim::Error(unreadable_input) for a mask or trees that cannot be read, a mask of another size than the
  /// camera's, and a camera that sees no sky.
  FrameFilter(const sim::Scene& scene, const std::string& mask, const std::string& trees);

  /// Classifies a photograph in the pixels of its file, to which the mask is not applied, with the scene's
  /// site and camera. Throws as frame_features() does.
  FilterFinding classify(const Photo& photo, const sim::Scene& scene, double utc_s) const;

  /// SHA-256 of the trees.
  const std::string& sha256() const { return sha256_; }

 private:
  FilterCells cells_;
  SkyTrees trees_;
  std::string sha256_;
};

}  // namespace vegard::fit
