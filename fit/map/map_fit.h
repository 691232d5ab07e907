// The fit of a precipitation map to photographs: all of `vegard map` except reading and writing.
//
// Stages, each a finished step of the journal: maps on a coarse film for several strengths of the prior, one
// of which is chosen by parts of the picture that were left out (cross-validation, Stone 1974); the map on
// the fine film, over the cells where the coarse one has light; solutions for perturbed data, from which
// error bars follow. The same scene and photographs give the same bytes for every number of threads.
#pragma once

#include <vector>

#include "fit/map/map_result.h"

namespace vegard::fit {

/// Maps the scene's photographs: `photos` are those of scene.fit.photos in their order, or the only one.
/// Sheets and other emitters of the scene are left out. Throws sim::Error(scene) for sizes that differ, a
/// picture without usable sky (a camera that looks down), stations without a common volume,
/// sim::Error(unreadable_input) for a picture without light above its noise, and MapStopped.
MapResult map_photos(const sim::Scene& scene, const std::vector<Photo>& photos, const MapOptions& options);

}  // namespace vegard::fit
