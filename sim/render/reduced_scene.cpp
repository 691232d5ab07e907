#include "sim/render/reduced_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/emit/aurora/sheet.h"
#include "sim/light/electron.h"

namespace vegard::sim {

double expected_deflection_points(const Scene& scene) {
  double points = 0.0;
  for (const Sheet& sheet : scene.sheets) {
    points += 2.0 / path_step_of(sheet) * beams_per_layer(sheet) * sheet.layers * sheet.arcs;
  }
  return points * scene.time.instants;
}

Scene reduced_scene(const Scene& scene, const Reduction& reduction) {
  Scene reduced = scene;
  // A picture of depth is of the camera's own size.
  const PictureSize size = scene.march.depth.empty() ? size_within(scene.camera, reduction.most)
                                                     : PictureSize{scene.camera.width, scene.camera.height};
  reduced.camera = scaled_camera(scene.camera, size);
  reduced.march.smooth_px *= static_cast<double>(size.width) / scene.camera.width;
  reduced.march.step_km = std::max(scene.march.step_km, reduction.step_km);
  reduced.march.step_cells = std::max(scene.march.step_cells, reduction.step_cells);
  reduced.march.shrink = std::max(scene.march.shrink, reduction.shrink);
  const double share = reduction.points / std::max(1.0, expected_deflection_points(scene));
  if (share < 1.0)
    for (Sheet& sheet : reduced.sheets) {
      // The number of beams is set directly, so that no limit of beams_per_km applies.
      sheet.beams = std::max(1, static_cast<int>(std::lround(beams_per_layer(sheet) * share)));
      sheet.beams_per_km = sheet.points_per_px = 0.0;
    }
  return reduced;
}

}  // namespace vegard::sim
