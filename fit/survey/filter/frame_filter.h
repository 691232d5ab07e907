// Decides whether a frame has an arc that is worth a fit, and what else it shows.
#pragma once

#include <string>

#include "fit/survey/filter/frame_features.h"
#include "fit/survey/filter/sky_trees.h"

namespace vegard::fit {

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
  FilterFinding look(const Photo& photo, const sim::Scene& scene, double utc_s) const;

  /// SHA-256 of the trees.
  const std::string& sha256() const { return sha256_; }

 private:
  FilterCells cells_;
  SkyTrees trees_;
  std::string sha256_;
};

}  // namespace vegard::fit
