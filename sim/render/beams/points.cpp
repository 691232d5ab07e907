#include "sim/render/beams/points.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/base/parallel.h"
#include "sim/render/beams/beams.h"
#include "sim/render/beams/kernel.h"
#include "sim/render/beams/kernel_scene.h"
#include "sim/scene/emitters/emitter_kinds.h"

namespace vegard::sim {
namespace {

constexpr std::size_t kGroupsAtOnce = 32;  // whose points are held in memory

/// Which beams of a layer are kept.
struct Thinning {
  int every, first, kept;
  double weight;  ///< of each of them: as many as the layer has for one that is kept

  Thinning(int beams, int of_every)
      : every(of_every),
        first(std::min(of_every, beams) / 2),
        kept((beams - first + every - 1) / every),
        weight(static_cast<double>(beams) / kept) {}

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

int max_beams_of_a_layer(const Scene& scene) {
  int most = 0;
  for (const Sheet& sheet : scene.sheets) most = std::max(most, beams_per_layer(sheet));
  return most;
}

/// About how many points there are: steps of the path are random, half of the largest in the mean.
double expected_points(const Scene& scene, const BeamLayout& layout, int every) {
  double points = 0.0;
  for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
    const Sheet& sheet = scene.sheets[s];
    const double layers = static_cast<double>(sheet.arcs) * sheet.layers;
    points +=
        layers * Thinning(beams_per_layer(sheet), every).kept * 2.0 / layout.path_step(static_cast<int>(s));
  }
  return points;
}

/// Between two odd numbers.
int odd_middle(int low, int high) { return low + (high - low) / 4 * 2; }

}  // namespace

std::uint64_t stream_points(const Scene& scene, const PointOptions& options,
                            const std::function<void(const EmissionPoints&)>& sink) {
  assert(options.every % 2 == 1);
  Scene still = scene;
  still.time.instants = 1;
  still.emission.lag = EmissionLag::none;
  remove_emitters(still);  // the points are those of the beams, whatever is drawn in their place
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
  const auto stopped = [stop] { return stop != nullptr && stop->load(); };
  const auto enough = [&](int every) {
    options.every = every;
    return stream_points(scene, options, [](const EmissionPoints&) {}) <= most;
  };
  const int last = max_beams_of_a_layer(scene) | 1;  // one beam of each layer

  // Counting takes long, so the search begins at the number that the expected count suggests, and widens.
  Scene still = scene;
  still.time.instants = 1;
  still.emission.lag = EmissionLag::none;
  remove_emitters(still);  // the points are those of the beams, whatever is drawn in their place
  const BeamLayout layout(still, 0.0);
  int low = -1, high = last;  // `low` is too little, or below all
  while (high - low > 2) {
    const int middle = odd_middle(low, high);
    (expected_points(still, layout, middle) <= static_cast<double>(most) ? high : low) = middle;
  }
  const int guess = high;
  low = -1;
  high = last + 2;  // not yet known to be enough, and above all
  (enough(guess) ? high : low) = guess;
  for (int stride = 2; !stopped() && low == -1 && high > 1; stride *= 2) {
    const int every = std::max(1, high - stride);
    (enough(every) ? high : low) = every;
  }
  for (int stride = 2; !stopped() && high == last + 2 && low < last; stride *= 2) {
    const int every = std::min(last, low + stride);
    (enough(every) ? high : low) = every;
  }
  while (!stopped() && high > 1 && high - low > 2) {
    const int middle = odd_middle(low, high);
    (enough(middle) ? high : low) = middle;
  }
  return stopped() || high > last ? 0 : high;
}

}  // namespace vegard::sim
