// Refining the curtains of a map by beams: `vegard fit --from-map`.
//
// Each curtain becomes a sheet whose course is a curve (fit/map/curtain_sheets.h), and all of them together
// go downhill from where the map has them, with exact derivatives. Then curves are tried to be left out, the
// weakest first, and curtains that the map holds below its brightness limit to be added, the strongest first;
// each time all others settle again, and BIC (fit/answer/information_criteria.h) says whether the change
// stays. Where one was added, what it may stand in place of is tried to be left out once more. Two refusals
// in a row end a round. All of these models are compared with the same values and the same sigma.
#pragma once

#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/map/curtain_sheets.h"
#include "fit/photo/photo.h"
#include "fit/search/fit_options.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// `scene` says where the cameras are, what is compared and what is free beside the curtains; its sheets and
/// emitters are left out. `photos` are those of scene.fit.photos in their order, or the only one. At least
/// one curtain. options.max_evaluations counts all descents together. Throws as fit_photos() does.
FitResult fit_curtains(const sim::Scene& scene, const std::vector<Photo>& photos,
                       const std::vector<Ridge>& curtains, const std::vector<Ridge>& faint,
                       const FitOptions& options);

}  // namespace vegard::fit
