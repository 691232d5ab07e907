// The edges of a film as planes through the camera, so that what surely misses it need not be worked out.
#pragma once

#include "sim/view/camera/camera.h"

namespace vegard::sim {

struct FilmEdges {
  int count = 0;         ///< of planes; 0: the film is too wide for any
  double outward[4][3];  ///< a point in the camera's axes with a positive product is off the film; any length
};

/// Of the film and a cell more on every side.
FilmEdges film_edges(const Lens<double>& lens, const FilmGeometry& film);

}  // namespace vegard::sim
