// Where a scene's camera looks, for tables and plots.
#pragma once

#include <functional>

#include "sim/scene/scene.h"

namespace vegard::apps {

/// Elevation above the horizon in degrees of a point of the image, as the scene's camera sees it.
std::function<double(double x_px, double y_px)> elevation_of_pixel(const sim::Scene& scene);

}  // namespace vegard::apps
