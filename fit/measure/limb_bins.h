// Bins by the distance from the Sun's middle and by position angle: radial profiles of its corona.
#pragma once

#include "fit/measure/bin_grid.h"

namespace vegard::fit {

/// Groups are `fit.bands` equal sectors of position angle about the Sun's middle, from its north pole
/// anticlockwise (through solar east, as position angles go); positions are steps of `fit.limb_step` of the
/// distance from the middle, in radii of the photosphere, from `fit.limb_lowest` to `fit.limb_highest`. The
/// distance is that of the line of sight at its nearest: a line of sight that touches the limb has 1.
///
/// Throws sim::Error(scene): with key "fit.limb_lowest" unless it is below fit.limb_highest; with
/// "fit.limb_step" if fewer than three positions lie between; with "sun.shown" if the scene has no Sun; with
/// "sun.azimuth_deg" if no pixel of the region is at such a distance.
BinGrid limb_bins(const sim::Scene& scene, const Region& region);

}  // namespace vegard::fit
