// Footprints of a scene's sheets: the energy flux of their beams as a map.
#pragma once

#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns all sheets of the scene on the footprint's grid, in mW m^-2: the energy flux of every beam is
/// distributed linearly to the four cells around its foot and divided by the area of a cell. There are many
/// more beams than those of the sheets, so that the map is close to the mean over draws; folds, curls, rays
/// (their light, not their lengths) and patches are those of the sheets. For an exposure the map is the mean
/// over its instants. Where sheets overlap, the flux adds up, and ln E is the mean weighted by flux. A sheet
/// of given brightness has the flux of the Maxwellian electrons of its energy that produce it. The grid's
/// energy is ln(E / footprint.energy_kev). For T = FreeDual `number` may give tangents to the sheets'
/// parameters. All instants are shifted back by `age_s`.
template <class T>
PlaneFootprint<T> sheet_plane(const Scene& scene, const Footprint& footprint, const NumberAs<T>& number,
                              int threads, double age_s = 0.0);

/// Returns the number of beams per layer of a sheet, for cells with this edge.
int footprint_beams(const Sheet& sheet, double cell_km);

}  // namespace vegard::sim
