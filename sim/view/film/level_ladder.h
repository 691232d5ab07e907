// Light that is spread by a different Gaussian for every point of it: a ladder of films, each blurred by one
// width.
//
// A point's light is shared between the two levels that its variance lies between, so that the total and the
// variance are exact. The shape is that of two Gaussians of variances v and up to 2 v: half-way between two
// levels a point's peak is 12 % too high, and that of a line across which one looks 5 %. The
// lowest level is not blurred; from 0.71 pixels on each level is sqrt(2) times as wide as the one below.
// Wide levels have cells of several pixels, a power of two: a point falls on 3 x 3 cells by the quadratic
// B-spline, the cells are blurred, and the picture is the cubic B-spline through them. B-splines of degree 2
// and 3 spread a point by the same variance wherever it lies, 1/4 and 1/3 of a cell's square (the moments of
// the sum of 3 or 4 boxes, 3/12 and 4/12; de Boor, "A Practical Guide to Splines", chapter IX), which is what
// makes exact books possible.
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
  double variance_px2 = 0.0;  ///< of a point's image, beyond the 1/6 pixel^2 that the bilinear splat has
  /// A point falls on the 3 x 3 cells around it, else on 2 x 2, bilinearly.
  bool smooth() const { return film.cell_width_px > 1.0; }
  std::size_t cells() const { return static_cast<std::size_t>(film.rows) * film.columns; }
};

/// The levels for a picture of this size up to the first that is at least `widest_px` wide.
std::vector<BlurLevel> level_ladder(int width_px, int height_px, double widest_px);

/// The four cells of a cubic B-spline that a place's value depends on, and how much.
struct CubicTaps {
  int first = 0;
  float weight[4] = {};
};

/// Of the middles of `places` cells of a picture or a film, the first of which begins at `first_px`, on cells
/// that begin at `start_px`.
std::vector<CubicTaps> cubic_taps(int places, double step_px, double first_px, double start_px,
                                  double cell_px);

/// Which two levels share a point's light.
struct LevelShare {
  int lower = 0;             ///< and lower + 1
  float upper_share = 0.0f;  ///< the rest is the lower level's
};

/// The shares of a point that is spread by `variance_px2`, on `levels` (at least 2) levels of rising
/// variance. What is wider than the last level goes to the last level.
inline LevelShare level_share(const float* level_variances_px2, int levels, float variance_px2) {
  int lower = 0;
  while (lower + 2 < levels && variance_px2 >= level_variances_px2[lower + 1]) ++lower;
  const float low = level_variances_px2[lower], high = level_variances_px2[lower + 1];
  const float share = (variance_px2 - low) / (high - low);
  return {lower, share < 1.0f ? share : 1.0f};
}

/// Blurs what has fallen on a level's cells and adds it to one channel of a picture, per pixel. Overwrites
/// `cells`.
void add_level(const BlurLevel& level, std::vector<float>& cells, Image& picture, int channel, int threads);

}  // namespace vegard::sim
