#include "sim/view/camera/widest_angle.h"

#include <algorithm>
#include <cmath>

namespace vegard::sim {

double widest_angle_rad(const Lens<double>& lens, const FilmGeometry& film) {
  double least = 1.0;
  for (const double x_px :
       {film.x0_px - film.cell_width_px, film.x0_px + (film.columns + 1) * film.cell_width_px})
    for (const double y_px :
         {film.y0_px - film.cell_height_px, film.y0_px + (film.rows + 1) * film.cell_height_px}) {
      double direction[3] = {0.0, 0.0, lens.least_cosine};
      unproject(lens, x_px, y_px, direction);
      least = std::min(least, direction[2]);
    }
  return std::acos(std::clamp(least, lens.least_cosine, 1.0));
}

}  // namespace vegard::sim
