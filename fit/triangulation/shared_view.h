// What two cameras see of the same shell, and the outline of what one sees, for maps.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fit/triangulation/view_point.h"

namespace vegard::fit {

/// Elevation from which on a view counts: lower down the air hides and bends light.
inline constexpr double kLowestShared_deg = 8.0;

/// Returns the place at which a line of sight first reaches a height; none if it meets the ground before, or
/// the camera is above.
std::optional<Eigen::Vector3d> place_at_height(const ViewPoint& view, const Eigen::Vector3d& direction,
                                               double height_km);

/// Returns the share of the first camera's sky, counted in pixels, that the second one sees at this height.
double shared_sky(const ViewPoint& first, const ViewPoint& second, double height_km);

/// Returns the places at this height around what the camera sees of it, in their order; empty if nothing.
std::vector<GeodeticPlace> view_outline(const ViewPoint& view, double height_km);

}  // namespace vegard::fit
