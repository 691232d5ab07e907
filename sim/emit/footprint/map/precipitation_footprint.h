// A footprint from a map of precipitation.
#pragma once

#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/light/sample.h"
#include "sim/scene/file/precipitation_file.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The footprint as its map's electrons have it: energy_kev and energy_flux_mw_m2 are the means of its cells,
/// weighed by energy flux (of the energy that of its logarithm, of the cells that have one), and home is the
/// site that the map's file names, or the footprint's own. A dark map leaves all as it is.
Footprint with_map(const Footprint& footprint, const PrecipitationMap& map);

/// The map as a grid, its energies over those of with_map(). A cell that has none has that of its
/// neighbours, so that light fades out by its flux alone, or else the mean. No number of the scene moves it.
/// T is double or FreeDual.
template <class T>
PlaneFootprint<T> precipitation_plane(const Footprint& footprint, const PrecipitationMap& map);

extern template PlaneFootprint<double> precipitation_plane(const Footprint&, const PrecipitationMap&);
extern template PlaneFootprint<FreeDual> precipitation_plane(const Footprint&, const PrecipitationMap&);

}  // namespace vegard::sim
