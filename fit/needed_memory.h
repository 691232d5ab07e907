// How much memory a fit takes, worked out before any is taken.
#pragma once

#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Bytes at the worst moment of a fit of the scene's photographs, or of one of its camera's size, and of the
/// report: from above, of a picture that is full of light. Judges (--bootstrap, --mcmc) add little.
double fit_bytes(const sim::Scene& scene, int threads);

}  // namespace vegard::fit
