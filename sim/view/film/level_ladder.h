// Blurs points of light by a different Gaussian for each point: with a ladder of films, each blurred by one
// width.
//
// A point's light is shared between the two levels with the next lower and higher variance, so that the total
// and the variance are exact. The shape is that of two Gaussians of variances v and up to 2 v: half-way
// between two levels the peak of a point is 12 % too high, and that of a line 5 %. The lowest level is not
// blurred; from 0.71 pixels on, each level is sqrt(2) times as wide as the one below. Wide levels have cells
// of several pixels, a power of two: a point is distributed on 3 x 3 cells by the quadratic B-spline, the
// cells are blurred, and the picture is the cubic B-spline with these coefficients. B-splines of degree 2 and
// 3 spread a point by the same variance wherever it is, 1/4 and 1/3 of a cell's square (the moments of the
// sum of 3 or 4 boxes, 3/12 and 4/12; de Boor, "A Practical Guide to Splines", chapter IX), so that the total
// variance is exact.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/base/image.h"
#include "sim/view/camera/camera.h"
#include "sim/view/film/blur.h"

namespace vegard::sim {

struct BlurLevel {
  FilmGeometry film;          ///< square cells, with a margin for the level's own blur
  BlurKernel kernel;          ///< in cells
  double variance_px2 = 0.0;  ///< of a point's image, in addition to the 1/6 pixel^2 of the bilinear splat
  /// True if a point is distributed on the 3 x 3 cells around it; else on 2 x 2, bilinearly.
  bool smooth() const { return film.cell_width_px > 1.0; }
  std::size_t cells() const { return static_cast<std::size_t>(film.rows) * film.columns; }
};

/// Returns the levels for a picture of this size, up to the first that is at least `widest_px` wide.
std::vector<BlurLevel> level_ladder(int width_px, int height_px, double widest_px);

/// The two levels that share a point's light.
struct LevelShare {
  int lower = 0;             ///< the other level is lower + 1
  float upper_share = 0.0f;  ///< share of level lower + 1
};

/// Returns the shares of a point with the variance `variance_px2` on `levels` (at least 2) levels of
/// increasing variance. A point that is wider than the last level is all on that level.
inline LevelShare level_share(const float* level_variances_px2, int levels, float variance_px2) {
  int lower = 0;
  while (lower + 2 < levels && variance_px2 >= level_variances_px2[lower + 1]) ++lower;
  const float low = level_variances_px2[lower], high = level_variances_px2[lower + 1];
  const float share = (variance_px2 - low) / (high - low);
  return {lower, share < 1.0f ? share : 1.0f};
}

/// Blurs the light on a level's cells and adds it to one channel of a picture, per pixel. Overwrites `cells`.
void add_level(const BlurLevel& level, std::vector<float>& cells, Image& picture, int channel, int threads);

// Blurs planes of light on a film by a different Gaussian for each cell: with a ladder of films, each blurred
// by one width.
//
// Like the levels above, but for light that is already on a film, and for cells that are not
// square. Each level is √√2 times as wide as the one below; the peak of a cell that is shared between two
// levels is at most 3 % too high.

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
