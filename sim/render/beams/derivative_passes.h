// Which free parameters one pass of the kernel takes the derivatives by.
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

/// As few passes as will do, at least one: none has more than kTangentWidth parameters, nor more that beams
/// share than the kernel carries (kMaxCarried less beam_inputs, sim/light/sample.h). `free` are numbers of
/// the scene.
std::vector<DerivativePass> derivative_passes(const Scene& scene, const std::vector<ParameterId>& free);

}  // namespace vegard::sim
