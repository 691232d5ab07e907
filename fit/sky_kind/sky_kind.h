// What kind of sky a photograph shows, with probabilities, by features that hold for cameras never seen
// before.
//
// Aurora or none is right in nine of ten pictures of cameras that the model has not seen, the kind in three
// of five, each camera counted once (docs/sky_kind.md).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"
#include "fit/sky_kind/kinds.h"
#include "fit/sky_kind/sky_features.h"

namespace vegard::fit {

struct SkyFinding {
  SkyKind kind = SkyKind::clear;                  ///< the likeliest of those with aurora, or of those without
  double probability = 0.0;                       ///< of that kind
  std::array<double, kSkyKinds> probabilities{};  ///< of each kind; their sum is 1
  double aurora = 0.0;                            ///< probability of any aurora
  bool is_kind_sure = false;  ///< the kind has three fifths of the probability of aurora, or of none
  std::string sentence;       ///< "Aurora (83 %): one arc (70 %).", "Aurora (83 %), kind unsure: …"
  SkyFeatures features{};
};

/// Returns the pixels that are no sky as far as can be told without being asked: outside of a fisheye's
/// circle or below a skyline, and captions.
PixelSet not_sky(const Photo& photo);

/// Finds the kind of sky in the pixels of the photograph that are not left out. Throws
/// sim::Error(unreadable_input) if no sky is left.
SkyFinding kind_of_sky(const Photo& photo, const PixelSet& left_out);

/// The same by features that are known already, those of fit/sky_kind/sky_lines.h among them.
SkyFinding kind_of_sky(const SkyFeatures& features);

}  // namespace vegard::fit
