// The edges of a film as planes through the camera, to skip points that are surely off the film.
#pragma once

#include "sim/view/camera/camera.h"

namespace vegard::sim {

struct FilmEdges {
  int count = 0;         ///< number of planes; 0: the film is too wide for planes
  double outward[4][3];  ///< normals, of any length: a positive product with a point is off the film
};

/// Returns the edges of the film, enlarged by one cell on every side.
FilmEdges film_edges(const Lens<double>& lens, const FilmGeometry& film);

}  // namespace vegard::sim
