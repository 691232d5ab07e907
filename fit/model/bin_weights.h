// Bin weights: the weight of each cell of a film in each bin of a profile.
#pragma once

#include <memory>
#include <vector>

#include "fit/measure/bin_grid.h"
#include "fit/photo/photo.h"
#include "sim/render/cell_weights.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {

/// Returns weights for means over the usable pixels of the bins of several grids, each grid's bins after
/// those of the one before. The film's cells are whole numbers of pixels high, with a cell border at the
/// upper left corner of the grids' region. A pixel has the light of the cell in which its centre lies.
sim::CellWeights bin_weights(const Photo& photo, const std::vector<std::shared_ptr<const BinGrid>>& grids,
                             const sim::FilmGeometry& film);

}  // namespace vegard::fit
