// A film of a whole picture, one cell per pixel, exposed once.
#pragma once

#include "sim/render/film.h"

namespace vegard::tests {

inline sim::FilmGeometry whole_picture(const sim::Scene& scene) {
  sim::FilmGeometry film;
  film.columns = scene.camera.width;
  film.rows = scene.camera.height;
  return film;
}

inline sim::Exposure exposed(const sim::Scene& scene, const sim::FilmGeometry& film) {
  sim::Exposure exposure;
  sim::make_exposer(scene, film, 0)->expose(scene, exposure);
  return exposure;
}

inline sim::Exposure exposed(const sim::Scene& scene) { return exposed(scene, whole_picture(scene)); }

}  // namespace vegard::tests
