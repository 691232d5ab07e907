// Bins by distance from the Sun's centre and by position angle: radial profiles of its corona.
#pragma once

#include "fit/measure/bin_grid.h"

namespace vegard::sim {
struct Scene;
}

namespace vegard::fit {

/// Returns bins about the Sun's centre. Groups are `fit.bands` equal sectors of position angle, from the
/// Sun's north pole anticlockwise (through solar east); positions are steps of `fit.limb_step` of the
/// distance from the centre, in radii of the photosphere, from `fit.limb_lowest` to `fit.limb_highest`. The
/// distance is the smallest distance between the line of sight and the centre: 1 for a line of sight that
/// touches the limb.
///
/// Throws sim::Error(scene): with key "fit.limb_lowest" unless it is below fit.limb_highest; with
/// "fit.limb_step" if fewer than three positions lie between the two; with "sun.shown" if the scene has no
/// Sun; with "sun.azimuth_deg" if no pixel of the region is within these distances.
BinGrid limb_bins(const sim::Scene& scene, const Region& region);

}  // namespace vegard::fit
