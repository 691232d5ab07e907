// The grid of a box's footprint, and how numbers that are fixed in the box become a scene's.
#pragma once

#include "sim/emit/footprint/footprint_map.h"
#include "sim/light/emitter.h"
#include "sim/scene/scene.h"

namespace vegard::sim {

/// The grid of a box without anything on it: whole cells, at least as many as cover size_km, about the box's
/// middle.
template <class T>
PlaneFootprint<T> plane_grid(const Footprint& footprint);

/// A footprint in units of energy_flux_mw_m2 that stands still in its box, as T: times that number. Where
/// center_km has tangents, the grid stays and what is on it moves, by the central differences of the map.
template <class T>
PlaneFootprint<T> as_free(const PlaneFootprint<double>& unit, const Footprint& footprint,
                          const NumberAs<T>& number);

}  // namespace vegard::sim
