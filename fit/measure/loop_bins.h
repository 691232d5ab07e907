// Bins along and across a loop (of the Sun's corona) that the user has drawn on a photograph.
#pragma once

#include "fit/measure/bin_grid.h"

namespace vegard::sim {
struct Scene;
}

namespace vegard::fit {

/// Returns the bins about the curve through the guide points (fit/measure/guide_curve.h). Groups are
/// `fit.bands` equal lengths of the curve, from its start; positions are steps of `fit.guide_cell_px` across
/// the curve, from -`fit.guide_half_width_px` on its left to +`fit.guide_half_width_px` on its right, in the
/// direction of the curve. A pixel is assigned by the point of the curve nearest to its centre; pixels beyond
/// either end belong to no bin.
///
/// Throws sim::Error(scene): with key "fit.guide_x_px" or "fit.guide_y_px" for fewer than three points, lists
/// of unequal length, points that coincide or are outside of the picture; with "fit.guide_half_width_px" if
/// fewer than five positions fit into the width; with "fit.bands" if bands are shorter than a pixel; with
/// "fit.roi_px" if no pixel of the region is near the curve.
BinGrid loop_bins(const sim::Scene& scene, const Region& region);

}  // namespace vegard::fit
