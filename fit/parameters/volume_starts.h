// Starts of a search over what is not made of sheets: footprints, nebulae, density nodes, grids, and the Sun
// with what stands on it.
//
// Their light changes smoothly with their numbers, so a descent from the user's start is the rule. Where a
// footprint's distance is free it is worth a look around: a near arc of low energy and a far one of high
// energy shine at like heights in the picture, with a ridge of bad fits between.
#pragma once

#include <optional>
#include <vector>

#include "fit/parameters/free_parameters.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// `values` with every footprint `distance` times as far from the observer, as far as its centre and its
/// points are free, and `energy` times the energy.
std::vector<double> moved_footprints(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                                     std::vector<double> values, double distance, double energy);

/// Whether that would change anything.
bool has_movable_footprint(const std::vector<FreeNumber>& free);

/// How far a number of a volume may well be from its start; none where nothing says so. As a normal prior it
/// keeps a search from drifting off along what the data do not determine.
std::optional<double> usual_error(const sim::Scene& scene, const FreeNumber& number, double share);

/// Whether two points have their footprints apart: one tenth of the distance, or a quarter of the energy.
bool footprints_differ(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                       const std::vector<double>& a, const std::vector<double>& b);

}  // namespace vegard::fit
