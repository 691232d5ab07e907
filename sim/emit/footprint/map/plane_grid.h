// The grid of a box's footprint, and how numbers that are fixed in the box become a scene's.
#pragma once

#include <vector>

#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The grid of a box without anything on it: whole cells, at least as many as cover size_km, about the box's
/// middle.
template <class T>
PlaneFootprint<T> plane_grid(const Footprint& footprint);

/// A footprint in units of energy_flux_mw_m2 that stands still in its box, as T: times that number.
template <class T>
PlaneFootprint<T> as_free(const PlaneFootprint<double>& unit, const Footprint& footprint,
                          const NumberAs<T>& number);

/// The mean of footprints of one size whose corners in the south-west stand at `corners_km`, or of a single
/// one in all those places, on a grid that holds all of them. The flux of a cell is shared out, linearly,
/// among the four that it comes to lie on; ln E is the mean, weighed by flux.
template <class T>
PlaneFootprint<T> mean_of(const std::vector<PlaneFootprint<T>>& planes,
                          const std::vector<EastNorth>& corners_km);

/// Gives a footprint that goes with its box the tangents of center_km: the grid stays and what is on it
/// moves, by the central differences of the map.
void move_with_centre(const Footprint& footprint, const NumberAs<FreeDual>& number,
                      PlaneFootprint<FreeDual>& plane);
/// Plain numbers have none.
inline void move_with_centre(const Footprint&, const NumberAs<double>&, PlaneFootprint<double>&) {}

}  // namespace vegard::sim
