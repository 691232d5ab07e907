// The volumes' light as it is seen: marched at a coarser resolution, softened, with glow.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/parallel.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/render/volumes/limb.h"
#include "sim/render/volumes/volumes.h"
#include "sim/view/film/blur.h"
#include "sim/view/film/depth_image.h"

namespace vegard::sim {
namespace {

bool is_spread(const March& march) { return march.smooth_px > 0.0 || march.glow > 0.0; }

/// Applies the smoothing and the glow of [march] to planes of light; linear in the light.
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

VolumeLight march_coarsely(const FilmGeometry& film, int shrink, const EndsOfRays& ends,
                           const MarchCells& march, int threads) {
  const FilmGeometry coarse = coarse_film(film, shrink);
  const VolumeLight few = march(coarse, {});
  const std::vector<float> few_ends = ends(coarse), all_ends = ends(film);
  const std::size_t cells = all_ends.size(), few_cells = few_ends.size();
  std::vector<DepthTaps> taps(cells);
  std::vector<std::uint8_t> alone(cells, 0);
  parallel_for(static_cast<std::size_t>(film.rows), threads, [&](std::size_t row, int) {
    for (int column = 0; column < film.columns; ++column) {
      const std::size_t cell = row * film.columns + column;
      if (std::isnan(all_ends[cell])) continue;
      taps[cell] = depth_taps(coarse, shrink, few_ends.data(), static_cast<int>(row), column, all_ends[cell]);
      alone[cell] = !taps[cell].matched;
    }
  });
  // The film, of which these cells are right already.
  VolumeLight light;
  if (std::find(alone.begin(), alone.end(), 1) != alone.end()) {
    light = march(film, alone);
  } else {
    light.lines = few.lines;
    light.rayleigh.assign(cells * few.lines, 0.0f);
    light.depth_km.assign(cells, std::numeric_limits<float>::infinity());
    if (!few.kept.empty()) light.kept.assign(cells * few.lines, 1.0f);
  }
  parallel_for(static_cast<std::size_t>(film.rows), threads, [&](std::size_t row, int) {
    for (std::size_t cell = row * film.columns; cell < (row + 1) * film.columns; ++cell) {
      if (!taps[cell].matched) continue;
      light.depth_km[cell] = few.depth_km[taps[cell].nearest()];
      for (int l = 0; l < few.lines; ++l) {
        light.rayleigh[l * cells + cell] = taps[cell].mean(few.rayleigh.data() + l * few_cells);
        if (!few.kept.empty())
          light.kept[l * cells + cell] = taps[cell].mean(few.kept.data() + l * few_cells);
      }
    }
  });
  return light;
}

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
  if (!whole_resolution)
    if (const std::vector<std::uint8_t> cells = limb_cells(scene, film, threads_); !cells.empty())
      march_limb(film, cells, march, light);
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
