// The bins of vertical profiles: along the picture's columns, along elevation, or along field lines.
#pragma once

#include "fit/measure/bin_grid.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Returns the bins along the picture's columns: a bin is `rows` rows of a band; the last one may have fewer.
/// Throws sim::Error(scene) with key "fit.bands" unless 1 <= bands <= the region's width.
BinGrid column_bins(const Region& region, int bands, int rows = 1);

/// Returns the bins along elevation. Bands are strips of columns; a pixel's position is the row at which the
/// curve of constant elevation through the pixel crosses the region's middle column, even if the horizon is
/// tilted or curved. Pixels whose curve crosses the column outside of the region, or beyond the highest point
/// in the column, belong to no bin.
BinGrid elevation_bins(const Region& region, int bands, const sim::Camera& camera);

/// Returns the bins along the projections of field lines. A pixel's position is its row; its band is the one
/// in which the projected field line through the pixel crosses the region's middle row. The projections of a
/// uniform field's lines are straight and converge at the magnetic zenith, so bands are sheared and fan out
/// from there. Pixels beyond the magnetic zenith, or whose line crosses outside of the region, belong to no
/// bin.
BinGrid field_bins(const Region& region, int bands, const sim::Camera& camera, const sim::Field& field);

/// Returns the bins that fit.profile_along names, including those of the Sun.
/// Throws sim::Error(scene) with key "fit.profile_along" if it is "field" and the field is not
/// uniform.
BinGrid profile_bins(const sim::Scene& scene, const Region& region);

// Bins by distance from the Sun's centre and by position angle: radial profiles of its corona.

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

// Bins along and across a loop (of the Sun's corona) that the user has drawn on a photograph.

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
