// The circle that a fisheye lens draws: sky inside, the dark inside of the camera outside.
#pragma once

#include <optional>
#include <vector>

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// A circle in pixels: x to the right, y down, the centre of the first pixel at (0.5, 0.5).
struct Circle {
  double x_px = 0.0, y_px = 0.0, radius_px = 0.0;
};

struct CircleFound {
  Circle circle;
  double rms_px = 0.0;    ///< distance from the circle of the boundary points that agree with it
  double agreeing = 0.0;  ///< share of the rays that cross it inside the picture that have such a point
};

/// Finds the circle by RANSAC (Fischler and Bolles 1981, Commun. ACM 24, 381), with a seed, so that the draws
/// are always the same. Boundary points are those where the brightness (fit/photo/mask/plane.h) along a ray
/// from the centre falls by more than 0.02 within eight pixels to a level that stays dark up to the picture's
/// edge. Of the drawn circles through three of them, the one with which most rays agree is refined by least
/// squares of the distances of the points within its tolerance; and all of that is repeated from the new
/// centre. Returns nothing if less than a third of the rays that cross the circle inside the picture agree,
/// if their points lie on less than a quarter of its circumference, or in pictures of less than 64 pixels.
std::optional<CircleFound> find_circle(const Photo& photo);

/// Returns the pixels whose centres are farther from the circle's centre than its radius less the margin.
PixelSet outside_of(const Circle& circle, int width, int height, double margin_px);

struct BoundaryPoint {
  double x_px, y_px;
  int ray;  ///< several points may lie on one ray; at most one of them is the boundary
};

/// The picture's size limits the circles: their centres lie in the picture, and their radii are between a
/// fifth and one and a half of its shorter side.
struct CircleLimits {
  int width, height;
};

struct FittedCircle {
  Circle circle;
  std::vector<BoundaryPoint> agreeing;  ///< one per ray, the nearest
  double rms_px = 0.0;
};

/// Returns the circle through three drawn points with which most rays agree (within 1.5 pixels and 0.004 of
/// the radius; the first of equals), refined by Gauss-Newton steps of the distances of the agreeing points,
/// which are chosen anew after each. Returns nothing for fewer than three rays, or if no draw is within the
/// limits.
std::optional<FittedCircle> fit_circle(const std::vector<BoundaryPoint>& points, const CircleLimits& limits);

}  // namespace vegard::fit
