// The grid of ground cells of a map: how far it reaches and how fine it is.
#pragma once

#include <vector>

#include "fit/map/map_observation.h"
#include "sim/render/ground/ground_grid.h"
#include "sim/scene/structs/site.h"

namespace vegard::fit {

inline constexpr double kMappedBorder_km = 105.0;  ///< altitude that lower borders are taken to have

/// Returns the distance on the ground of a border seen at the lowest elevation of a picture.
double ground_reach_km(const std::vector<MapObservation>& pictures);

/// Returns the grid about the site, and for several stations about all of them. `coarseness`: factor on the
/// sides of its cells.
sim::GroundGrid map_grid(const std::vector<MapObservation>& pictures, const sim::Site& home,
                         double farthest_km, double coarseness);

/// Returns, for each fine cell, whether it is near to a coarse one that has light in the map `rough`.
std::vector<bool> cells_near_light(const sim::GroundGrid& coarse, const std::vector<float>& rough,
                                   const std::vector<double>& energies_kev, const sim::GroundGrid& fine);

/// Returns a coarse map on a finer grid, with a little light everywhere.
std::vector<float> refined_map(const std::vector<float>& rough, const sim::GroundGrid& coarse,
                               const sim::GroundGrid& fine);

/// The largest number of a map.
float brightest(const std::vector<float>& map);

/// A map on another grid: what is under the middles of its cells, 0 where there is nothing.
std::vector<float> regridded(const std::vector<float>& map, const sim::GroundGrid& from,
                             const sim::GroundGrid& to);

/// The mean of a finer map in each coarse cell.
std::vector<float> coarsened(const std::vector<float>& map, const sim::GroundGrid& from,
                             const sim::GroundGrid& to);

}  // namespace vegard::fit
