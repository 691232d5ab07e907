// Planes of light on a film of any cells, spread by a different Gaussian from cell to cell: a ladder of
// films, each blurred by one width.
//
// Like sim/view/film/level_ladder.h, but for light that has fallen on a film already, and for cells that are
// not square. Each level is √√2 times as wide as the one below, so that a cell that is shared between two has
// a peak 3 % too high at most.
#pragma once

#include <vector>

#include "sim/view/camera/camera.h"
#include "sim/view/film/blur.h"

namespace vegard::sim {

/// One direction of a level's film. Cells are as wide as the film's own or, of wide levels, a power of two as
/// wide and smooth: light falls on three of them by the quadratic B-spline, else on the nearest or on two.
struct LevelAxis {
  double start_px = 0.0, cell_px = 1.0;
  int cells = 0;
  bool smooth = false;
  BlurKernel kernel;  ///< in cells
};

struct FilmLevel {
  LevelAxis across, down;
  double variance_px2 = 0.0;  ///< mean of both directions'
  std::size_t cells() const { return static_cast<std::size_t>(down.cells) * across.cells; }
};

/// The levels about this film, up to the first that is at least `widest_px` wide; the lowest is not blurred.
/// At least two.
std::vector<FilmLevel> film_ladder(const FilmGeometry& film, double widest_px);

/// Adds what falls on a place of the picture, `width` numbers, to a level's planes [row][column][width], per
/// cell. What is not wholly on them is too far from the film to matter to it.
void splat_on_film_level(const FilmLevel& level, double x_px, double y_px, double weight, const float* light,
                         int width, float* cells);

/// Blurs what has fallen on a level, [row][column][width], by one thread. `scratch` is overwritten.
void blur_level(const FilmLevel& level, int width, std::vector<float>& cells, std::vector<float>& scratch);

/// Adds a blurred level to the planes of the film that the ladder was made for.
void add_film_level(const FilmLevel& level, const std::vector<float>& cells, const FilmGeometry& film,
                    int width, float* planes, int threads);

}  // namespace vegard::sim
