// Fits a scene to one photograph or to several.
#pragma once

#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"
#include "fit/search/fit_options.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Fits scene.fit.free to `photo`, by the statistics that have a weight in scene.fit. The photograph must
/// have the camera's size. Throws sim::Error for input that cannot be used (no free parameter, sizes that
/// differ, nothing usable in the region). Numerical trouble never throws: it leads to a verdict, and so does
/// a sheet that is out of view (failed). An unknown transfer curve is taken as sRGB; fit/transfer_curve_fit.h
/// finds it.
FitResult fit_photo(const sim::Scene& scene, const Photo& photo, const FitOptions& options);

/// Fits scene.fit.free to several photographs at once: those of scene.fit.photos, in their order. A free
/// number that belongs to one photograph changes only that photograph's scene. Sheets are given in the frame
/// of the scene's own site and carried over to the frame of each photograph (fit/parameters/photo_frame.h).
/// Throws as fit_photo() does, and for a photograph whose transfer curve is unknown.
FitResult fit_photos(const sim::Scene& scene, const std::vector<Photo>& photos, const FitOptions& options);

}  // namespace vegard::fit
