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

/// Returns the bins that fit.profile_along names, including those of the Sun (fit/measure/loop_bins.h and
/// limb_bins.h). Throws sim::Error(scene) with key "fit.profile_along" if it is "field" and the field is not
/// uniform.
BinGrid profile_bins(const sim::Scene& scene, const Region& region);

}  // namespace vegard::fit
