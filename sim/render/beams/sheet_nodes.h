// How densely sheets are looked at where the expected picture is wanted: the mean over all draws of beams.
//
// Along a sheet and down its field lines nodes stand at distances of so many pixels, as the camera sees them
// where the sheet is nearest, and close enough to each other for the sheet's own structures.
#pragma once

#include <vector>

#include "sim/emit/aurora/sheet.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// Whether a scene's picture has a mean that nodes can tell. Folds, curls and undulating borders stand where
/// a seed has put them: of them there are realisations alone.
bool has_expected_picture(const Scene& scene);

/// One per sheet, fine enough for means over bands of the film's columns, row by row, that are smoothed over
/// rows by `smooth_px`; `fineness` makes every distance so many times smaller.
std::vector<SheetNodes> sheet_nodes(const Scene& scene, const FilmGeometry& film, double smooth_px = 0.0,
                                    double fineness = 1.0);

}  // namespace vegard::sim
