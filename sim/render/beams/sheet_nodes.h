// How densely sheets are looked at, by the pixels of a film where the camera sees them nearest: the nodes
// that give the expected picture, which is the mean over all draws of beams, and the beams that a picture of
// one draw takes to be free of grain.
#pragma once

#include <vector>

#include "sim/emit/aurora/sheet.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// Whether a scene's picture has a mean that nodes can give. Folds, curls and undulating borders stand where
/// a seed has put them: of them there are realisations alone.
bool has_expected_picture(const Scene& scene);

/// One per sheet, fine enough for means over bands of the film's columns, row by row, that are smoothed over
/// rows by `smooth_px`; `fineness` makes every distance so many times smaller.
std::vector<SheetNodes> sheet_nodes(const Scene& scene, const FilmGeometry& film, double smooth_px = 0.0,
                                    double fineness = 1.0);

/// The scene with as many beams as Sheet::points_per_px asks for on this film, at least those that it has, at
/// most 16 times as many, and else those times a power of the square root of 2: what moves a little keeps
/// its beams.
Scene with_enough_beams(const Scene& scene, const FilmGeometry& film);

}  // namespace vegard::sim
