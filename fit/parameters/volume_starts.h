// Start values for a search over light sources that are not sheets: footprints, nebulae, density nodes,
// grids, and the Sun with the structures on it.
//
// Their light changes smoothly with their numbers, so normally a descent from the user's start suffices.
// Where a footprint's distance is free, other starts are needed: a near arc of low energy and a far one of
// high energy appear at similar heights in the picture, separated by worse fits.
#pragma once

#include <optional>
#include <vector>

#include "fit/parameters/free_parameters.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Returns `values` with every footprint moved to `distance` times its distance from the observer, as far as
/// its centre and its points are free, and with its energy multiplied by `energy`.
std::vector<double> moved_footprints(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                                     std::vector<double> values, double distance, double energy);

/// Whether moved_footprints() would change anything.
bool has_movable_footprint(const std::vector<FreeNumber>& free);

/// Returns how far a number of a volume may reasonably be from its start; none where no estimate exists. Used
/// as a normal prior, it keeps a search from drifting along directions that the data do not determine.
std::optional<double> usual_error(const sim::Scene& scene, const FreeNumber& number, double share);

/// Whether the footprints of two solutions differ by more than a tenth of the distance or a quarter of the
/// energy.
bool footprints_differ(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                       const std::vector<double>& a, const std::vector<double>& b);

}  // namespace vegard::fit
