#include "sim/render/volumes/volumes.h"

#include <algorithm>
#include <limits>

#include "sim/base/parallel.h"
#include "sim/render/beams/kernel_scene.h"
#include "sim/render/emitters/emitter_makers.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/render/volumes/row_march.h"

namespace vegard::sim {

bool has_volumes(const Scene& scene) { return has_drawn_emitters(scene); }

/// Emitters look into the scene that they are made of.
struct Volumes::Made {
  Scene scene;
  Emitters<double> emitters;
};

Volumes::Volumes(const Scene& scene, int threads, bool of_one_scene)
    : threads_(thread_count(threads)), files_(std::make_unique<VolumeFiles>(read_volume_files(scene))) {
  if (!of_one_scene) return;
  auto made = std::make_unique<Made>(Made{scene, {}});
  made->emitters = make_emitters<double>(made->scene, *files_, plain_number, threads_);
  made_ = std::move(made);
}

Volumes::~Volumes() = default;

MarchCells Volumes::marcher(const Scene& scene, const std::function<void(double)>& progress,
                            const std::atomic<bool>* stop) const {
  const auto rows = std::make_shared<RowMarch<double>>(scene, *files_, plain_number, threads_,
                                                       made_ ? &made_->emitters : nullptr);
  const int lines = static_cast<int>(scene.emission.lines.size());
  return [rows, lines, progress, stop, threads = threads_](const FilmGeometry& film,
                                                           const std::vector<std::uint8_t>& wanted) {
    VolumeLight light;
    light.lines = lines;
    const std::size_t cells = static_cast<std::size_t>(film.rows) * film.columns;
    light.rayleigh.assign(cells * lines, 0.0f);
    light.depth_km.assign(cells, std::numeric_limits<float>::infinity());
    if (rows->absorbs()) light.kept.assign(cells * lines, 1.0f);
    std::atomic<int> done{0};
    parallel_for(static_cast<std::size_t>(film.rows), threads, [&](std::size_t row, int slot) {
      if (stop != nullptr && stop->load(std::memory_order_relaxed)) return;
      rows->run(static_cast<int>(row), slot, film, wanted,
                [&](const RowOfRays<double>& rays, const RowLight<double>& sum) {
                  const std::size_t count = rays.column.size();
                  for (std::size_t i = 0; i < count; ++i) {
                    const std::size_t cell = row * film.columns + rays.column[i];
                    light.depth_km[cell] = static_cast<float>(sum.depth_km[i]);
                    for (int l = 0; l < lines; ++l) {
                      light.rayleigh[l * cells + cell] = static_cast<float>(sum.rayleigh[l * count + i]);
                      if (!light.kept.empty())
                        light.kept[l * cells + cell] = static_cast<float>(sum.kept[l * count + i]);
                    }
                  }
                });
      const int finished = ++done;
      if (progress && wanted.empty()) progress(static_cast<double>(finished) / film.rows);
    });
    return light;
  };
}

void Volumes::add_derivatives(const Scene& scene, const FilmGeometry& film,
                              const std::vector<ParameterId>& free, std::size_t stride,
                              float* derivative) const {
  const std::size_t cells = static_cast<std::size_t>(film.rows) * film.columns;
  const int lines = static_cast<int>(scene.emission.lines.size());
  for (std::size_t first = 0; first < free.size(); first += kTangentWidth) {
    const std::size_t count = std::min<std::size_t>(kTangentWidth, free.size() - first);
    const Seeds seeds(scene, free, first, count);
    RowMarch<FreeDual> rows(
        scene, *files_, [&](const double& number) { return seeds(number); }, threads_);
    parallel_for(static_cast<std::size_t>(film.rows), threads_, [&](std::size_t row, int slot) {
      rows.run(static_cast<int>(row), slot, film, {},
               [&](const RowOfRays<FreeDual>& rays, const RowLight<FreeDual>& sum) {
                 for (std::size_t i = 0; i < rays.column.size(); ++i)
                   for (int l = 0; l < lines; ++l) {
                     const FreeDual& light = sum.rayleigh[l * rays.column.size() + i];
                     float* to =
                         derivative + (l * cells + row * film.columns + rays.column[i]) * stride + first;
                     for (std::size_t j = 0; j < count; ++j) to[j] += static_cast<float>(light.d.t[j]);
                   }
               });
    });
  }
}

}  // namespace vegard::sim
