// The traces of the sky's cells in one frame, each with its probability of being a border of aurora.
#pragma once

#include <optional>
#include <vector>

#include "fit/border/border_trace.h"
#include "fit/border/sky_cells.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Traces the light of cells, without holes, and judges it. Azimuths and elevations are about the zenith,
/// whatever the cells' frame is. None if there is no light.
std::optional<std::vector<BorderTrace>> judged_traces(const SkyCells& cells, const Photo& photo,
                                                      const sim::Scene& scene,
                                                      const BorderSettings& settings);

}  // namespace vegard::fit
