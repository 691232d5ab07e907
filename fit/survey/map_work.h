// The results of a survey that come from the precipitation map of a frame: energy flux, energy and curtains.
#pragma once

#include <optional>

#include "fit/map/map_fit.h"
#include "fit/photo/photo.h"
#include "fit/survey/survey_answer.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Perturbed solutions, from which error bars follow: half as many as `vegard map` takes. Their spread tells
/// an error to a quarter of it.
inline constexpr int kSurveyReplicates = 8;
/// Curtains of which numbers are kept, those that carry most energy.
inline constexpr int kSurveyCurtains = 4;

/// Item 0, the map: power (MW), its mean E0 (keV, by energy flux), share of the energy flux whose lower
/// border is in view, chi2 per value, number of curtains. Items 1, 2, ..., curtains: length, and of the point
/// nearest to the site whose lower border is in view distance, azimuth, latitude (where the site has one),
/// E0, energy flux and lower border. The verdict is "good" if all of the map's are (fit/map/map_verdicts.h),
/// else "doubtful"; its words are theirs. None if options.stop was raised. The options' journal is not for
/// this. Throws as map_photos().
std::optional<WorkAnswer> map_answer(const Photo& photo, const sim::Scene& scene, const MapOptions& options);

}  // namespace vegard::fit
