// Where a camera looks, for tables and plots.
#pragma once

#include <functional>

#include "sim/scene/structs/scene.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::apps {

/// Elevation above the horizon in degrees of a point of the image, as the scene's camera sees it.
std::function<double(double x_px, double y_px)> elevation_of_pixel(const sim::Scene& scene);

/// The same by a map of the picture's size, of the pixel that the point is in.
std::function<double(double x_px, double y_px)> elevation_of_pixel(sim::DirectionMap map);

}  // namespace vegard::apps
