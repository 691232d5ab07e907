// The grid of a box's footprint, and the conversion of maps that are fixed in the box to those of a scene.
#pragma once

#include <vector>

#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/footprint.h"

namespace vegard::sim {

/// Returns the empty grid of a box: whole cells, as many as are needed to cover size_km, around the box's
/// middle.
template <class T>
PlaneFootprint<T> plane_grid(const Footprint& footprint);

/// Converts a footprint that is fixed in its box from units of energy_flux_mw_m2 to mW m^-2, as T.
template <class T>
PlaneFootprint<T> as_free(const PlaneFootprint<double>& unit, const Footprint& footprint,
                          const NumberAs<T>& number);

/// Returns the mean of footprints of one size whose south-west corners are at `corners_km`, or of a single
/// footprint at all these places, on a grid that contains all of them. The flux of a cell is distributed
/// linearly to the four cells that it overlaps; ln E is the mean weighted by flux.
template <class T>
PlaneFootprint<T> mean_of(const std::vector<PlaneFootprint<T>>& planes,
                          const std::vector<EastNorth>& corners_km);

/// Gives a footprint that moves with its box the tangents of center_km: the grid stays and the map moves on
/// it, with the map's central differences as derivatives.
void move_with_centre(const Footprint& footprint, const NumberAs<FreeDual>& number,
                      PlaneFootprint<FreeDual>& plane);
/// Plain numbers have no tangents.
inline void move_with_centre(const Footprint&, const NumberAs<double>&, PlaneFootprint<double>&) {}

}  // namespace vegard::sim
