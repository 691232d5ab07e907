// The results of a survey that come from the precipitation map of a frame: energy flux, energy and curtains.
#pragma once

#include <optional>

#include "fit/map/map_fit.h"
#include "fit/photo/photo.h"
#include "fit/survey/survey_answer.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Number of perturbed solutions for error bars, half as many as `vegard map` uses. With eight, an error bar
/// is known to a quarter.
inline constexpr int kSurveyReplicates = 8;
/// Number of curtains, those with most energy, whose numbers are stored.
inline constexpr int kSurveyCurtains = 4;

/// Computes the map of a frame. The answer's item 0 is the map: power (MW), mean E0 (keV, weighted by energy
/// flux), share of the energy flux whose lower border is in view, chi2 per value, number of curtains. Items
/// 1, 2, ... are curtains: their length; and for the point nearest to the site whose lower border is in view,
/// its distance, azimuth, latitude (if the site has one), E0, energy flux and lower border. The verdict is
/// "good" if all verdicts of the map are (fit/map/map_verdicts.h), else "doubtful"; WorkAnswer::words has
/// their words. None if options.stop was set. The options' journal is not used. Throws as map_photos().
std::optional<WorkAnswer> map_answer(const Photo& photo, const sim::Scene& scene, const MapOptions& options);

}  // namespace vegard::fit
