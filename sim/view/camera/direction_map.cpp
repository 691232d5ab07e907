#include "sim/view/camera/direction_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {
namespace {

constexpr float kMapNowhere = std::numeric_limits<float>::quiet_NaN();
constexpr double kLargestRadian = 6.2832;  ///< 2 pi
constexpr double kMinInRadians = 1.5;

DirectionMap empty_map(int width, int height) {
  DirectionMap map;
  map.width = width;
  map.height = height;
  map.azimuth_deg.assign(static_cast<std::size_t>(width) * height, kMapNowhere);
  map.elevation_deg = map.azimuth_deg;
  return map;
}

/// Returns the azimuth from 0 to below 360: as a float it may round up to 360.
float azimuth_from_0_to_360(double degrees) {
  const double turned = degrees - 360.0 * std::floor(degrees / 360.0);
  const float azimuth = static_cast<float>(turned);
  return azimuth < 360.0f ? azimuth : 0.0f;
}

bool is_direction(double azimuth, double elevation) {
  if (azimuth == 0.0 && elevation == 0.0) return false;
  // Comparisons that NaN fails.
  return azimuth >= -360.0 && azimuth <= 720.0 && elevation >= -90.0 && elevation <= 90.0;
}

}  // namespace

DirectionMap direction_map(const Camera& camera, int threads, const std::function<void(double)>& progress) {
  DirectionMap map = empty_map(camera.width, camera.height);
  const CameraView<double> view = camera_view(camera);
  std::mutex telling;
  int done = 0;
  parallel_for(static_cast<std::size_t>(map.height), threads, [&](std::size_t row, int) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < map.width; ++x) {
      double enu[3];
      if (!enu_of_pixel(view, x + 0.5, y + 0.5, enu)) continue;
      const Direction direction = direction_of_enu(enu);
      if (!std::isfinite(direction.azimuth_deg) || !std::isfinite(direction.elevation_deg)) continue;
      map.azimuth_deg[map.index(x, y)] = azimuth_from_0_to_360(direction.azimuth_deg);
      map.elevation_deg[map.index(x, y)] = static_cast<float>(direction.elevation_deg);
    }
    if (!progress) return;
    const std::lock_guard<std::mutex> lock(telling);
    progress(static_cast<double>(++done) / map.height);
  });
  return map;
}

DirectionMap direction_map(const Image& azimuth, const Image& elevation, const std::string& azimuth_name,
                           const std::string& elevation_name) {
  if (azimuth.width != elevation.width || azimuth.height != elevation.height)
    throw unreadable(elevation_name,
                     "the map of elevations has " + size_text(elevation.width, elevation.height) + " pixels")
        .expected(size_text(azimuth.width, azimuth.height) + ", as the map of azimuths, " + azimuth_name);
  DirectionMap map = empty_map(azimuth.width, azimuth.height);
  double largest = 0.0;
  bool any = false;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const double az = azimuth.at(x, y, 0), el = elevation.at(x, y, 0);
      if (!is_direction(az, el)) continue;
      any = true;
      largest = std::max({largest, std::abs(az), std::abs(el)});
      map.azimuth_deg[map.index(x, y)] = azimuth_from_0_to_360(az);
      map.elevation_deg[map.index(x, y)] = static_cast<float>(el);
    }
  if (!any)
    throw unreadable(elevation_name, "no pixel of the maps looks anywhere")
        .expected("azimuths and elevations in degrees");
  // Less than a quarter turn in all is a narrow field near north, if it is not in radians.
  if (largest > kMinInRadians && largest <= kLargestRadian)
    throw unreadable(azimuth_name, "no angle in the maps is above 2 pi: they seem to be in radians")
        .expected("degrees");
  return map;
}

Image image_of(const DirectionMap& map) {
  Image image(map.width, map.height, {"azimuth_deg", "elevation_deg"});
  for (std::size_t i = 0; i < map.azimuth_deg.size(); ++i) {
    image.data[2 * i] = map.azimuth_deg[i];
    image.data[2 * i + 1] = map.elevation_deg[i];
  }
  return image;
}

}  // namespace vegard::sim
