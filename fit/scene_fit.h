// Does all of `vegard fit` except reading and writing, for any scene and its photographs.
#pragma once

#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/map/curtains/stored_map.h"
#include "fit/photo/photo.h"
#include "fit/search/fit_options.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct SceneFitOptions : FitOptions {
  bool stability = false;  ///< whether the fit is repeated with other choices (fit/stability.h)
};

/// Throws sim::Error(scene) for a scene with [[key]].
void require_still(const sim::Scene& scene);

/// Calls fit_curtains() if there is a map, fit_photos() where the scene names its photographs, and else
/// fit_photo() or, where the transfer curve is unknown, fit_photo_and_transfer_curve(). The latter leaves the
/// photograph decoded by the curve that was found. Throws as these functions do.
FitResult fit_scene(const sim::Scene& scene, std::vector<Photo>& photos, const StoredMap* map,
                    const SceneFitOptions& options);

}  // namespace vegard::fit
