// Where every pixel of a camera looks: the azimuth and elevation maps that imager teams publish with their
// pictures, and the same of a scene's camera.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Of the pixels' centres, row-major: [y * width + x], rows as in the picture that it belongs to. Both are
/// NaN where a pixel looks nowhere (outside of a fisheye's circle).
struct DirectionMap {
  int width = 0, height = 0;
  std::vector<float> azimuth_deg;    ///< from north to the east, 0 <= azimuth < 360
  std::vector<float> elevation_deg;  ///< above the horizon, -90 to 90

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

/// Of a scene's camera.
DirectionMap direction_map(const Camera& camera);

/// From the first channels of two images of one size. A pixel looks nowhere where either is no finite number;
/// where the elevation lies beyond -90 to 90 or the azimuth beyond -360 to 720 (fill values such as -999);
/// and where both are exactly 0, with which published maps fill the outside of their circle. Other azimuths
/// are brought between 0 and 360. Throws Error(unreadable_input), with the images' names, if the sizes
/// differ, no pixel looks anywhere, or all angles are so small (at most 2 pi) that they must be radians.
DirectionMap direction_map(const Image& azimuth, const Image& elevation, const std::string& azimuth_name,
                           const std::string& elevation_name);

/// Channels "azimuth_deg", "elevation_deg".
Image image_of(const DirectionMap& map);

}  // namespace vegard::sim
