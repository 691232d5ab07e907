// Refines the curtains of a map in a fit by beams: `vegard fit --from-map`.
//
// Each curtain becomes a sheet along a curve (fit/map/curtain_sheets.h). All sheets are first fitted together
// by a descent with exact derivatives that starts from the map. Then the fit tries to leave out curves, the
// weakest first, and to add curtains that are below the map's brightness limit, the strongest first. After
// each change all other parameters are fitted again, and the change is kept if it lowers the BIC
// (fit/answer/information_criteria.h). After an addition, the fit tries again to leave out the curves that
// the new one may replace. Two rejected changes in a row end a round. All these models are compared with the
// same values and the same sigma.
#pragma once

#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/map/curtain_sheets.h"
#include "fit/photo/photo.h"
#include "fit/search/fit_options.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Fits sheets to the ridges `curtains`, of which there must be at least one; `faint` are the ridges that the
/// fit may add. `scene` gives the cameras, what is compared, and the free parameters other than those of the
/// curtains; its sheets and emitters are left out. `photos` are those of scene.fit.photos in their order, or
/// the only one. options.max_evaluations limits the sum over all descents. Throws as fit_photos() does.
FitResult fit_curtains(const sim::Scene& scene, const std::vector<Photo>& photos,
                       const std::vector<Ridge>& curtains, const std::vector<Ridge>& faint,
                       const FitOptions& options);

}  // namespace vegard::fit
