// Blurs planes of light on a film by a different Gaussian for each cell: with a ladder of films, each blurred
// by one width.
//
// Like sim/view/film/level_ladder.h, but for light that is already on a film, and for cells that are not
// square. Each level is √√2 times as wide as the one below; the peak of a cell that is shared between two
// levels is at most 3 % too high.
#pragma once

#include <vector>

#include "sim/view/camera/camera.h"
#include "sim/view/film/blur.h"

namespace vegard::sim {

/// One direction of a level's film. Cells have the width of the film's cells or, for wide levels, a power of
/// two times that width. Wide cells are `smooth`: light is distributed on three cells by the quadratic
/// B-spline, else on the nearest or on two.
struct LevelAxis {
  double start_px = 0.0, cell_px = 1.0;
  int cells = 0;
  bool smooth = false;
  BlurKernel kernel;  ///< in cells
};

struct FilmLevel {
  LevelAxis across, down;
  double variance_px2 = 0.0;  ///< mean of both directions
  std::size_t cells() const { return static_cast<std::size_t>(down.cells) * across.cells; }
};

/// Returns the levels for this film, up to the first that is at least `widest_px` wide; the lowest is not
/// blurred. At least two.
std::vector<FilmLevel> film_ladder(const FilmGeometry& film, double widest_px);

/// Adds the light of a point of the picture, `width` numbers, to a level's planes [row][column][width], per
/// cell. Points that are not completely on the planes are too far from the film to affect it.
void splat_on_film_level(const FilmLevel& level, double x_px, double y_px, double weight, const float* light,
                         int width, float* cells);

/// Blurs the light on a level, [row][column][width], in one thread. `scratch` is overwritten.
void blur_level(const FilmLevel& level, int width, std::vector<float>& cells, std::vector<float>& scratch);

/// Adds a blurred level to the planes of the film for which the ladder was made.
void add_film_level(const FilmLevel& level, const std::vector<float>& cells, const FilmGeometry& film,
                    int width, float* planes, int threads);

}  // namespace vegard::sim
