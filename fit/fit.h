// Fitting a scene to a photograph.
#pragma once

#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"
#include "fit/search/fit_options.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Fits scene.fit.free to `photo`, by the statistics that scene.fit weighs. The photograph must have the
/// camera's size. Throws sim::Error for input that cannot be used (no free parameter, sizes that differ,
/// nothing usable in the region); numerical trouble is a verdict, never an exception. A sheet that cannot be
/// seen is a verdict too (failed). An unknown transfer curve is taken as sRGB: fit/curve_fit.h finds it.
FitResult fit_photo(const sim::Scene& scene, const Photo& photo, const FitOptions& options);

/// Fits scene.fit.free to several photographs at once: those of scene.fit.photos, in their order. A number
/// that belongs to one photograph moves that one's scene; sheets are given in the frame of the scene's own
/// site and carried over to a photograph's (fit/parameters/photo_frame.h). Throws as fit_photo() does, and
/// for one whose transfer curve is unknown.
FitResult fit_photos(const sim::Scene& scene, const std::vector<Photo>& photos, const FitOptions& options);

}  // namespace vegard::fit
