// The scenes of the recovery scorecard: drawn at random within the ranges of the source paper
// (docs/validation.md, "Recovery scorecard").
#pragma once

#include <cstdint>

#include "sim/scene/structs/scene.h"

namespace vegard::scorecard {

struct Truth {
  sim::Scene scene;            ///< valid; its gain is only found when it is photographed
  bool line_of_sight = false;  ///< whether it is drawn by integration along lines of sight, not by beams
  double exposure = 0.0;       ///< of the brightest row of any band and channel, of white
};

/// Scene number `scene` of the set `set`: a pure function of both.
Truth truth(std::uint64_t set, int scene);

}  // namespace vegard::scorecard
