// A footprint from a map of precipitation.
#pragma once

#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/light/sample.h"
#include "sim/scene/file/precipitation_file.h"
#include "sim/scene/structs/footprint.h"

namespace vegard::sim {

/// Returns the footprint with the parameters of its map: energy_kev and energy_flux_mw_m2 are means over the
/// map's cells, weighted by energy flux (for the energy of its logarithm, over the cells that have one), and
/// home is the site in the map's file, or else the footprint's own. For a dark map it returns the footprint
/// unchanged.
Footprint with_map(const Footprint& footprint, const PrecipitationMap& map);

/// Returns the map as a grid, with energies over the energy_kev of with_map(). A cell without energy gets
/// that of its neighbours, so that light fades out by its flux alone, or else the mean. The grid does not
/// depend on any free parameter. T is double or FreeDual.
template <class T>
PlaneFootprint<T> precipitation_plane(const Footprint& footprint, const PrecipitationMap& map);

extern template PlaneFootprint<double> precipitation_plane(const Footprint&, const PrecipitationMap&);
extern template PlaneFootprint<FreeDual> precipitation_plane(const Footprint&, const PrecipitationMap&);

}  // namespace vegard::sim
