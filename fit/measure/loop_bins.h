// Bins along a loop that somebody has drawn on a photograph, and across it.
#pragma once

#include "fit/measure/bin_grid.h"

namespace vegard::fit {

/// A curve is laid through the guide points (fit/measure/guide_curve.h). Groups are `fit.bands` equal lengths
/// of it, from its start; positions are steps of `fit.guide_cell_px` across, from -`fit.guide_half_width_px`
/// on its left to + on its right, as somebody walks along it over the picture. A pixel belongs to where the
/// curve is nearest to its centre; what lies beyond either end belongs to no bin.
///
/// Throws sim::Error(scene): with key "fit.guide_x_px" or "fit.guide_y_px" for fewer than three points,
/// unequal numbers, points on top of each other or outside of the picture; with "fit.guide_half_width_px" if
/// fewer than five positions fit into it; with "fit.bands" if bands are shorter than a pixel; with
/// "fit.roi_px" if no pixel of the region is near the curve.
BinGrid loop_bins(const sim::Scene& scene, const Region& region);

}  // namespace vegard::fit
