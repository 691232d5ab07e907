// Bin weights: the share of each part of a film that falls into each bin of a profile.
#pragma once

#include <memory>
#include <vector>

#include "fit/measure/bin_grid.h"
#include "fit/photo/photo.h"
#include "sim/render/cell_weights.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {

/// The means over the usable pixels of the bins of some grids, one grid's after the other's, on a film whose
/// cells are whole numbers of pixels high, with a cell border at the grids' region's upper left corner. A
/// pixel's light is that of the cell that its centre lies in.
sim::CellWeights bin_weights(const Photo& photo, const std::vector<std::shared_ptr<const BinGrid>>& grids,
                             const sim::FilmGeometry& film);

}  // namespace vegard::fit
