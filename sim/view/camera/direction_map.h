// The direction of every pixel of a camera: the maps of azimuth and elevation that are published with
// pictures of imagers, and those of a scene's camera.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/camera.h"

namespace vegard::sim {

struct Camera;

/// Directions of the pixels' centres, row-major: [y * width + x], with rows as in the picture. Both angles
/// are NaN where a pixel has no direction (outside of a fisheye's circle).
struct DirectionMap {
  int width = 0, height = 0;
  std::vector<float> azimuth_deg;    ///< from north to the east, 0 <= azimuth < 360
  std::vector<float> elevation_deg;  ///< above the horizon, -90 to 90

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

/// Returns the map of a scene's camera. `threads`: 0 for all cores; the map does not depend on it. `progress`
/// is told the finished share, 0 to 1, by one thread at a time.
DirectionMap direction_map(const Camera& camera, int threads = 0,
                           const std::function<void(double)>& progress = {});

/// Makes a map from the first channels of two images of the same size. A pixel has no direction if a value is
/// not finite; if the elevation is beyond -90 to 90 or the azimuth beyond -360 to 720 (fill values such as
/// -999); or if both are exactly 0, as outside of the circle in published maps. Other azimuths are reduced to
/// 0 to 360. Throws Error(unreadable_input), with the images' names, if the sizes differ, no pixel has a
/// direction, or all angles are so small (at most 2 pi) that they must be radians.
DirectionMap direction_map(const Image& azimuth, const Image& elevation, const std::string& azimuth_name,
                           const std::string& elevation_name);

/// Returns an image with the channels "azimuth_deg" and "elevation_deg".
Image image_of(const DirectionMap& map);

}  // namespace vegard::sim
