// From the march of the volumes to their light as it is seen: at a coarser resolution, softened, with glow.
#include "sim/render/emitters/depth_file.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/render/volumes/coarse_march.h"
#include "sim/render/volumes/volumes.h"
#include "sim/view/film/blur.h"

namespace vegard::sim {
namespace {

bool is_spread(const March& march) { return march.smooth_px > 0.0 || march.glow > 0.0; }

/// What [march] makes of planes of light, linear in it.
void spread(const Scene& scene, const FilmGeometry& film, const Planes& planes, int threads) {
  const March& march = scene.march;
  if (march.smooth_px > 0.0)
    soften(planes, march.smooth_px / film.cell_height_px, march.smooth_px / film.cell_width_px, threads);
  const double glow_px = march.glow_deg * pixels_per_degree(scene.camera);
  if (march.glow > 0.0)
    spread_glow(planes, march.glow, glow_px / film.cell_height_px, glow_px / film.cell_width_px, threads);
}

void turn_over(LargeVector<float>& shares) {
  for (float& share : shares) share = 1.0f - share;
}

}  // namespace

VolumeLight Volumes::light(const Scene& scene, const FilmGeometry& film,
                           const std::function<void(double)>& progress, const std::atomic<bool>* stop,
                           bool whole_resolution) const {
  const bool shrinks = scene.march.shrink > 1 && !whole_resolution;
  const MarchCells march = marcher(scene, progress, stop);
  const EndsOfRays ends = [&](const FilmGeometry& of) {
    return ray_ends_km(scene, of, files_->depth, threads_);
  };
  VolumeLight light =
      shrinks ? march_coarsely(film, scene.march.shrink, ends, march, threads_) : march(film, {});
  if (!is_spread(scene.march)) return light;
  spread(scene, film, {light.rayleigh.data(), light.lines, film.rows, film.columns}, threads_);
  if (!light.kept.empty() && scene.march.smooth_px > 0.0) {
    // Light and what it hides behind it go together. Outside of the film nothing is hidden.
    turn_over(light.kept);
    soften({light.kept.data(), light.lines, film.rows, film.columns},
           scene.march.smooth_px / film.cell_height_px, scene.march.smooth_px / film.cell_width_px, threads_);
    turn_over(light.kept);
  }
  return light;
}

void Volumes::add_light_derivatives(const Scene& scene, const FilmGeometry& film,
                                    const std::vector<ParameterId>& free, std::size_t stride,
                                    float* derivative) const {
  if (!is_spread(scene.march)) {
    add_derivatives(scene, film, free, stride, derivative);
    return;
  }
  const int lines = static_cast<int>(scene.emission.lines.size());
  std::vector<float> own(static_cast<std::size_t>(film.rows) * film.columns * lines * stride, 0.0f);
  add_derivatives(scene, film, free, stride, own.data());
  spread(scene, film, {own.data(), lines, film.rows, film.columns, static_cast<int>(stride)}, threads_);
  for (std::size_t i = 0; i < own.size(); ++i) derivative[i] += own[i];
}

}  // namespace vegard::sim
