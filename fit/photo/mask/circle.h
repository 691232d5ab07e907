// The circle that a fisheye lens draws: sky inside, the dark inside of the camera outside.
#pragma once

#include <optional>
#include <vector>

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// In pixels, x to the right, y down, the centre of the first pixel at (0.5, 0.5).
struct Circle {
  double x_px = 0.0, y_px = 0.0, radius_px = 0.0;
};

struct CircleFound {
  Circle circle;
  double rms_px = 0.0;    ///< distance from the circle of the boundary points that agree with it
  double agreeing = 0.0;  ///< share of the rays that cross it inside the picture that have such a point
};

/// Points of the boundary are where brightness (fit/photo/mask/plane.h) along a ray from the centre falls by
/// more than 0.02 within eight pixels to a level that stays dark up to the picture's edge. Of the circles
/// through three of them that are drawn (Fischler and Bolles 1981, Commun. ACM 24, 381; seeded, so always the
/// same draws) the one that most rays agree with is refined by least squares of the distances, of the points
/// within its tolerance only; and that from the new centre again. None if less than a third of the rays that
/// cross the circle inside the picture agree, or if their points are in less than a quarter of its
/// circumference; none in pictures of less than 64 pixels.
std::optional<CircleFound> find_circle(const Photo& photo);

/// Pixels whose centres are farther from the circle's centre than its radius less the margin.
PixelSet outside_of(const Circle& circle, int width, int height, double margin_px);

struct BoundaryPoint {
  double x_px, y_px;
  int ray;  ///< several points may lie on one ray; at most one of them is the boundary
};

/// What circles are looked for in: their centres lie in the picture, and radii are between a fifth and one
/// and a half of the shorter side.
struct CircleLimits {
  int width, height;
};

struct FittedCircle {
  Circle circle;
  std::vector<BoundaryPoint> agreeing;  ///< one per ray, the nearest
  double rms_px = 0.0;
};

/// The circle through three drawn points that most rays agree with (within 1.5 pixels and 0.004 of the
/// radius), refined by least squares of the distances of the agreeing points (Gauss-Newton), by turns. Ties
/// go to the first drawn. None for fewer than three rays, or if no draw is within the limits.
std::optional<FittedCircle> fit_circle(const std::vector<BoundaryPoint>& points, const CircleLimits& limits);

}  // namespace vegard::fit
