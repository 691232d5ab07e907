#include "sim/render/volumes/literal_nebula.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "sim/base/parallel.h"
#include "sim/emit/nebula/literal_march.h"
#include "sim/emit/nebula/nebula_frame.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

Image literal_nebula_picture(const Scene& scene, const Nebula& nebula, const Image* depth_km, int threads) {
  const NumberAs<double> number = [](const double& value) { return value; };
  const NodeMap<double> map(scene, number);
  const LiteralCloud cloud = literal_cloud(map, nebula);
  const NebulaFrame<double> frame(nebula, number);
  const CameraView<double> view = camera_view(scene.camera);
  const double observer_km = scene.site.altitude_m * 1e-3;
  const std::array<double, 3> origin = {0.0, 0.0, frame.observer_distance()};
  Image picture(scene.camera.width, scene.camera.height, {"R", "G", "B", "A"});
  parallel_for(static_cast<std::size_t>(picture.height), threads, [&](std::size_t row, int) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < picture.width; ++x) {
      double enu[3];
      if (!enu_of_pixel(view, x + 0.5, y + 0.5, enu)) continue;
      double end_km = ground_km(observer_km, enu[2], scene.body.radius_km);
      if (depth_km != nullptr) end_km = std::min(end_km, static_cast<double>(depth_km->at(x, y, 0)));
      // What stands nearer than the nebula's bound hides it; only an observer inside has it before that.
      std::array<double, 3> direction;
      frame.turn(enu, direction.data());
      const std::array<double, 4> rgba = literal_march(cloud, origin, direction, end_km / frame.unit_km());
      for (int channel = 0; channel < 4; ++channel)
        picture.at(x, y, channel) = static_cast<float>(rgba[channel]);
    }
  });
  return picture;
}

}  // namespace vegard::sim
