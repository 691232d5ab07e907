// The bins of vertical profiles: along the picture's columns, along elevation, along the field's lines.
#pragma once

#include "fit/measure/bin_grid.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Vertical profiles along the picture's columns: a bin is `rows` rows of a band, of which the last one may
/// have fewer. Throws sim::Error(scene) with key "fit.bands" unless 1 <= bands <= the region's width.
BinGrid column_bins(const Region& region, int bands, int rows = 1);

/// Along elevation: bands are those of columns; a pixel's position is the row at which the curve of its
/// elevation crosses the region's middle column, wherever in the picture the horizon is. What crosses it
/// outside of the region, or beyond its highest point there, belongs to no bin.
BinGrid elevation_bins(const Region& region, int bands, const sim::Camera& camera);

/// Along the field line's projection: a pixel's position is its row; its band is that in which the picture of
/// the field line through it crosses the region's middle row. The pictures of a uniform field's lines are
/// straight and meet in the magnetic zenith, so bands are sheared, and fan out from there. Pixels beyond the
/// magnetic zenith, or whose line crosses outside of the region, belong to no bin.
BinGrid field_bins(const Region& region, int bands, const sim::Camera& camera, const sim::Field& field);

/// By fit.profile_along; of the Sun's, fit/measure/loop_bins.h and limb_bins.h. Throws
/// sim::Error(scene) with key "fit.profile_along" if that is "field" and the field is not uniform.
BinGrid profile_bins(const sim::Scene& scene, const Region& region);

}  // namespace vegard::fit
