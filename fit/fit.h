// Fits a scene to one photograph or to several.
#pragma once

#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/map/curtains/curtain_sheets.h"
#include "fit/photo/photo.h"
#include "fit/search/fit_options.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Fits scene.fit.free to `photo`, by the statistics that have a weight in scene.fit. The photograph must
/// have the camera's size. Throws sim::Error for input that cannot be used (no free parameter, sizes that
/// differ, nothing usable in the region). Numerical trouble never throws: it leads to a verdict, and so does
/// a sheet that is out of view (failed). An unknown transfer curve is taken as sRGB;
/// fit_photo_and_transfer_curve() finds it.
FitResult fit_photo(const sim::Scene& scene, const Photo& photo, const FitOptions& options);

/// Fits scene.fit.free to several photographs at once: those of scene.fit.photos, in their order. A free
/// number that belongs to one photograph changes only that photograph's scene. Sheets are given in the frame
/// of the scene's own site and carried over to the frame of each photograph (fit/parameters/photo_frame.h).
/// Throws as fit_photo() does, and for a photograph whose transfer curve is unknown.
FitResult fit_photos(const sim::Scene& scene, const std::vector<Photo>& photos, const FitOptions& options);

/// Fits sheets to the ridges `curtains`, of which there must be at least one; `faint` are the ridges that the
/// fit may add. `scene` gives the cameras, what is compared, and the free parameters other than those of the
/// curtains; its sheets and emitters are left out. `photos` are those of scene.fit.photos in their order, or
/// the only one. options.max_evaluations limits the sum over all descents. Throws as fit_photos() does.
FitResult fit_curtains(const sim::Scene& scene, const std::vector<Photo>& photos,
                       const std::vector<Ridge>& curtains, const std::vector<Ridge>& faint,
                       const FitOptions& options);

/// Exponents over sRGB's light are searched between 1 / kMaxExponent and kMaxExponent.
inline constexpr double kMaxExponent = 4.0;

/// Does what fit_photo() does, for a photograph whose transfer curve has photo.unknowns unknown numbers.
/// Afterwards `photo` is decoded by the curve that was found, and its `decoding` says so. Error bars include
/// the uncertainty of the curve; gains and sky are those at the curve that was found. Throws sim::Error as
/// fit_photo() does, and for options that an unknown curve excludes: statistics other than the profile,
/// free-form height profiles, fit.photo_noise = "sensor", validation of the error bars.
FitResult fit_photo_and_transfer_curve(const sim::Scene& scene, Photo& photo, const FitOptions& options);

}  // namespace vegard::fit
