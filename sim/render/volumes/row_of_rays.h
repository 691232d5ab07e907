// The rays of one row of a film, and their light.
//
// For the files of this folder only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "sim/emit/sun/sun_frame.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// Finds where rays are stopped by the photosphere.
class SunBall {
 public:
  explicit SunBall(const Scene& scene)
      : shown_(scene.sun.shown), radius_(scene.sun.radius), frame_(scene.sun, plain_number) {}

  double end_km(const double enu[3]) const {
    if (!shown_) return std::numeric_limits<double>::infinity();
    const SkyRay<double> ray = frame_.sky().ray(enu);
    double half;
    if (!meets_sphere(ray, radius_, half) || ray.observer >= -half)
      return std::numeric_limits<double>::infinity();
    return (-half - ray.observer) * frame_.unit_km();
  }

 private:
  bool shown_;
  double radius_;
  SunFrame<double> frame_;
};

/// Returns the angle between the rays of neighbouring pixels of a row, in the middle of the picture.
inline double radians_per_px(const CameraView<double>& view, const Camera& camera) {
  double a[3], b[3];
  const double x = 0.5 * camera.width, y = 0.5 * camera.height;
  if (!enu_of_pixel(view, x - 0.5, y, a) || !enu_of_pixel(view, x + 0.5, y, b)) return 0.0;
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                   (a[2] - b[2]) * (a[2] - b[2]));
}

/// The rays of one row of a film, for the cells that are wanted and that the lens images.
template <class T>
struct RowOfRays {
  std::vector<int> column;
  std::vector<T> direction[3];
  std::vector<double> end_km;

  void aim(const CameraView<T>& view, const CameraView<double>& plain_view, const FilmGeometry& film, int row,
           const Scene& scene, const DepthImage& depth, const SunBall& sun,
           const std::vector<std::uint8_t>& wanted) {
    const double y_px = film.y0_px + (row + 0.5) * film.cell_height_px;
    column.clear();
    end_km.clear();
    for (auto& axis : direction) axis.clear();
    for (int c = 0; c < film.columns; ++c) {
      if (!wanted.empty() && wanted[static_cast<std::size_t>(row) * film.columns + c] == 0) continue;
      T enu[3];
      if (!enu_of_cell(view, film, row, c, enu)) continue;
      column.push_back(c);
      for (int axis = 0; axis < 3; ++axis) direction[axis].push_back(enu[axis]);
      const double towards[3] = {value_of(enu[0]), value_of(enu[1]), value_of(enu[2])};
      end_km.push_back(std::min(
          ray_end_km(plain_view, scene, depth, film.x0_px + (c + 0.5) * film.cell_width_px, y_px, towards),
          sun.end_km(towards)));
    }
  }

  RayBundle<T> bundle(double cell_rad) const {
    return {column.size(),
            {direction[0].data(), direction[1].data(), direction[2].data()},
            end_km.data(),
            cell_rad};
  }
};

/// The light of one emitter along the rays of a row.
template <class T>
struct RowLight {
  std::vector<T> rayleigh, kept, entry_moving;
  std::vector<double> entry_km, depth_km;

  BundleLight<T> clear(std::size_t rays, int lines) {
    rayleigh.assign(rays * lines, T(0.0));
    kept.assign(rays * lines, T(1.0));
    entry_km.assign(rays, std::numeric_limits<double>::infinity());
    depth_km.assign(rays, std::numeric_limits<double>::infinity());
    entry_moving.assign(rays, T(std::numeric_limits<double>::infinity()));
    return {lines, rayleigh.data(), kept.data(), entry_km.data(), depth_km.data(), entry_moving.data()};
  }
};

}  // namespace vegard::sim
