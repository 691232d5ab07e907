// Borders high up, of bands that pass near the zenith: there azimuths crowd, and a band runs along them
// instead of crossing them.
//
// The sky above 40 degrees is traced again about poles that are tilted by 45 degrees in eight directions. Of
// what is claimed there, what the upright frame has not, or has a lesser part of, is taken.
#pragma once

#include <vector>

#include "fit/border/border_trace.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Adds borders to the traces of the upright frame, and takes those away that are parts of them.
void add_high_borders(std::vector<BorderTrace>& traces, const Photo& photo, const sim::Scene& scene,
                      const BorderSettings& settings);

}  // namespace vegard::fit
