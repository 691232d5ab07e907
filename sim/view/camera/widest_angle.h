// How far off the lens's axis a film reaches.
#pragma once

#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// The angle off the axis of the film's farthest corner, a cell beyond its edge, in radians; that of the
/// lens's end if the film reaches beyond it.
double widest_angle_rad(const Lens<double>& lens, const FilmGeometry& film);

}  // namespace vegard::sim
