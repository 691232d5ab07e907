// The whole of `vegard fit` between reading and writing, whatever the scene and its photographs are.
#pragma once

#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/map/map_record.h"
#include "fit/photo/photo.h"
#include "fit/search/fit_options.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct SceneFitOptions : FitOptions {
  bool stability = false;  ///< whether the fit is repeated with other choices (fit/stability.h)
};

/// fit_curtains() of a map, if there is one; fit_photos() where the scene names its photographs; of the only
/// photograph fit_photo(), or fit_photo_and_curve() where its transfer curve is unknown. That one is decoded
/// by what was found of it afterwards. Throws as they do.
FitResult fit_scene(const sim::Scene& scene, std::vector<Photo>& photos, const MapRecord* map,
                    const SceneFitOptions& options);

}  // namespace vegard::fit
