#include "sim/render/points.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/base/parallel.h"
#include "sim/render/beams.h"
#include "sim/render/kernel.h"
#include "sim/render/kernel_scene.h"

namespace vegard::sim {
namespace {

constexpr std::size_t kGroupsAtOnce = 32;  // whose points are held in memory

/// Which beams of a layer are kept.
struct Thinning {
  int every, first;
  double weight;  ///< of each of them: as many as the layer has for one that is kept

  Thinning(int beams, int of_every) : every(of_every), first(std::min(of_every, beams) / 2) {
    const int kept = (beams - first + every - 1) / every;
    weight = static_cast<double>(beams) / kept;
  }

  void apply(std::vector<BeamGroup>& groups) const {
    for (BeamGroup& group : groups)
      for (int beam = 0; beam < kGroup; ++beam) {
        if (static_cast<int>(group.index[beam]) % every == first)
          group.flux_km2_mw_m2[beam] *= weight;
        else
          group.end_of_path[beam] = 0.0;
      }
  }
};

int most_beams_of_a_layer(const Scene& scene) {
  int most = 0;
  for (const Sheet& sheet : scene.sheets) most = std::max(most, beams_per_layer(sheet));
  return most;
}

}  // namespace

std::uint64_t stream_points(const Scene& scene, const PointOptions& options,
                            const std::function<void(const EmissionPoints&)>& sink) {
  assert(options.every % 2 == 1);
  Scene still = scene;
  still.time.instants = 1;
  const BeamLayout layout(still, 0.0);
  const std::vector<HeightProfile> profiles = height_profiles(still);
  const FilmGeometry no_film;
  std::vector<EmissionPoints> listed(kGroupsAtOnce);
  for (EmissionPoints& points : listed) points.lines = static_cast<int>(still.emission.lines.size());
  PackedChunk packed;
  std::uint64_t total = 0;
  std::size_t done = 0;
  for (const Chunk& chunk : layout.chunks()) {
    const KernelScene kernel =
        kernel_scene(still, still.sheets[chunk.sheet], layout.path_step(chunk.sheet), no_film, profiles);
    layout.pack(still, chunk, kernel, packed);
    if (options.every > 1)
      Thinning(beams_per_layer(still.sheets[chunk.sheet]), options.every).apply(packed.groups);
    for (std::size_t first = 0; first < packed.groups.size(); first += kGroupsAtOnce) {
      if (options.stop != nullptr && options.stop->load(std::memory_order_relaxed)) return total;
      const std::size_t count = std::min(kGroupsAtOnce, packed.groups.size() - first);
      parallel_for(count, options.threads, [&](std::size_t i, int) {
        listed[i].clear();
        list_points(kernel, &packed.groups[first + i], 1, listed[i]);
      });
      for (std::size_t i = 0; i < count; ++i) {
        total += listed[i].size();
        if (listed[i].size() > 0) sink(listed[i]);
      }
    }
    ++done;
    if (options.progress)
      options.progress(static_cast<double>(done) / static_cast<double>(layout.chunks().size()));
  }
  return total;
}

int thinning_for(const Scene& scene, std::uint64_t most, int threads, const std::atomic<bool>* stop) {
  PointOptions options;
  options.threads = threads;
  options.stop = stop;
  const auto count = [&](int every) {
    options.every = every;
    return stream_points(scene, options, [](const EmissionPoints&) {});
  };
  const auto odd = [](double number) { return static_cast<int>(std::ceil(std::min(number, 1e9))) | 1; };
  const int beams = most_beams_of_a_layer(scene);
  // A few beams tell about how many points all of them have.
  const int few = std::max(1, beams / 100) | 1;
  const double estimate = static_cast<double>(count(few)) * few;
  // From a little below the guess upwards, so that the smallest is not missed.
  int every = odd(0.9 * estimate / static_cast<double>(most));
  while (every <= beams && count(every) > most) {
    if (stop != nullptr && stop->load()) return 0;
    every += 2;
  }
  return every <= beams ? every : 0;
}

}  // namespace vegard::sim
