// How densely sheets are sampled, according to the size of a film's pixels at the part of a sheet nearest to
// the camera: the quadrature nodes for the expected picture, which is the mean over all draws of beams, and
// the number of beams with which a picture of one draw is free of visible grain.
#pragma once

#include <vector>

#include "sim/emit/aurora/sheet.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// True if quadrature nodes can give the mean of a scene's picture. Folds, curls and undulating borders are
/// placed by the seed; the program has only realisations of them, not their mean.
bool has_expected_picture(const Scene& scene);

/// Returns the nodes of every sheet, fine enough for means over bands of the film's columns, row by row, that
/// are smoothed over rows by `smooth_px`. All distances between nodes are divided by `fineness`.
std::vector<SheetNodes> sheet_nodes(const Scene& scene, const FilmGeometry& film, double smooth_px = 0.0,
                                    double fineness = 1.0);

/// Returns the scene with the number of beams that Sheet::points_per_px requires on this film, but at least
/// its own number and at most 16 times it. The factor is a power of the square root of 2, so that small
/// movements do not change the number.
Scene with_enough_beams(const Scene& scene, const FilmGeometry& film);

}  // namespace vegard::sim
