// Divides the free parameters among passes of the kernel, which carries a limited number of derivatives.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::sim {

/// Neighbours in the list of free parameters.
struct DerivativePass {
  std::size_t first = 0, count = 0;
};

/// Returns the smallest number of passes, at least one, of which none has more than kTangentWidth parameters,
/// nor more parameters common to all beams than the kernel carries (kMaxCarried - beam_inputs,
/// sim/light/sample.h). `free` are parameters of the scene.
std::vector<DerivativePass> derivative_passes(const Scene& scene, const std::vector<ParameterId>& free);

}  // namespace vegard::sim
