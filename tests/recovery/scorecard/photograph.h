// The photograph of a true scene: exposed, noisy, eight bits, JPEG.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"
#include "tests/recovery/scorecard/truth.h"

namespace vegard::scorecard {

struct Photograph {
  std::string bytes;  ///< of the file: sRGB, JPEG of quality 92 or PNG
  sim::Scene scene;   ///< the truth's, with the gain that it was exposed with
};

/// A pure function of the truth. Noise: photons, 8000 electrons at white, and 0.0015 of white for reading, as
/// one normal number per pixel and channel. threads: 0 for all cores.
Photograph photograph(const Truth& truth, int threads, bool is_lossless = false);

}  // namespace vegard::scorecard
