// A circle through points of which many are something else.
#pragma once

#include <optional>
#include <vector>

#include "fit/photo/mask/circle.h"

namespace vegard::fit {

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
