// Footprints of a scene's sheets: where their beams would start, as a density.
#pragma once

#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// All sheets of the scene on the footprint's grid, in mW m^-2: the energy flux of every beam shared out,
/// linearly, among the four cells about its foot, over the area of a cell. There are many more beams than the
/// sheets ask for, so that what comes out is what theirs would be on average; folds, curls, rays (their
/// light, not their lengths) and patches are those of the sheets. An exposure is the mean of its instants.
/// Where sheets overlap the flux adds, and ln E is the mean, weighed by flux. A sheet of given brightness has
/// the flux that Maxwellian electrons of its energy need for it. The grid's number for energy is ln(E /
/// footprint.energy_kev). For T = FreeDual `number` may give tangents to the sheets' numbers. All of it as it
/// was `age_s` before.
template <class T>
PlaneFootprint<T> sheet_plane(const Scene& scene, const Footprint& footprint, const NumberAs<T>& number,
                              int threads, double age_s = 0.0);

/// Beams laid out per layer of a sheet, for cells of this edge.
int footprint_beams(const Sheet& sheet, double cell_km);

}  // namespace vegard::sim
