// Decides whether a frame has an arc that is worth a fit, and what else it shows.
#pragma once

#include <optional>
#include <string>

#include "fit/sky_kind/sky_model.h"
#include "fit/survey/filter/frame_features.h"

namespace vegard::fit {

/// A frame's class: "arc" if there is one to be fitted, whatever else there is; else the first of twilight,
/// cloud, moon, lamp, aurora (without an arc) that is likelier than not; else "dark".
std::string sky_class(const SkyScores& scores);
bool has_arc(const SkyScores& scores);

struct FilterFinding {
  SkyFeatures features{};
  SkyScores scores{};
  std::string sky;  ///< the frame's class, from sky_class()
};

/// The filter for one camera during one of its calibrations.
class FrameFilter {
 public:
  /// `mask`, `model`: names with which the files can be opened; empty: no mask; the built-in model. Throws
  /// sim::Error(unreadable_input) for a mask or a model that cannot be read, a mask of another size than the
  /// camera's, and a camera that sees no sky.
  FrameFilter(const sim::Scene& scene, const std::string& mask, const std::string& model);

  /// Classifies a photograph in the pixels of its file, to which the mask is not applied, with the scene's
  /// site and camera. Throws as frame_features() does.
  FilterFinding classify(const Photo& photo, const sim::Scene& scene, double utc_s) const;

  /// SHA-256 of the model.
  const std::string& sha256() const { return sha256_; }

 private:
  FilterCells cells_;
  SkyModel model_;
  std::string sha256_;
};

}  // namespace vegard::fit
