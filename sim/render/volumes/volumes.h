// The scene's volumes on a film: footprints, nebulae and grids, marched along the rays of its cells.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "sim/base/large_vector.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

struct VolumeFiles;

/// What volumes put on a film. A ray meets several one after the other, in the order of where it enters them.
struct VolumeLight {
  int lines = 0;
  LargeVector<float> rayleigh;  ///< [line][row][column]
  LargeVector<float> kept;      ///< [line][row][column] of the light behind; empty: all of it
  LargeVector<float> depth_km;  ///< [row][column] mean distance of the light; infinity where there is none
};

/// Marches the cells of a film, [row][column], that `wanted` has nonzero; all if it is empty. What is not
/// wanted is dark and hides nothing.
using MarchCells =
    std::function<VolumeLight(const FilmGeometry& film, const std::vector<std::uint8_t>& wanted)>;

/// Whether the scene has any that shine in rayleighs.
bool has_volumes(const Scene& scene);

/// Made once for a scene, whose files it reads: later scenes may differ in their numbers.
class Volumes {
 public:
  /// Throws Error(unreadable_input) for a file that is missing or of no use. `of_one_scene`: what is worked
  /// out before rays are marched, as the footprints, is worked out here and now: later scenes may then differ
  /// in their camera alone.
  Volumes(const Scene& scene, int threads, bool of_one_scene = false);
  ~Volumes();

  /// What is to be seen: marched at the resolution of march.shrink (always at the film's own if
  /// `whole_resolution`), softened and with its glow, as [march] has them. `progress` and `stop` as in
  /// Exposer::expose().
  VolumeLight light(const Scene& scene, const FilmGeometry& film,
                    const std::function<void(double)>& progress = {}, const std::atomic<bool>* stop = nullptr,
                    bool whole_resolution = false) const;

  /// Adds the derivatives of the light at the film's own resolution by `free`, numbers of the
  /// scene, to [line][row][column][stride].
  void add_light_derivatives(const Scene& scene, const FilmGeometry& film,
                             const std::vector<ParameterId>& free, std::size_t stride,
                             float* derivative) const;

  /// The march alone, ready to be run on several films of this scene, which must outlive it.
  MarchCells marcher(const Scene& scene, const std::function<void(double)>& progress = {},
                     const std::atomic<bool>* stop = nullptr) const;

  /// The derivatives of the march alone.
  void add_derivatives(const Scene& scene, const FilmGeometry& film, const std::vector<ParameterId>& free,
                       std::size_t stride, float* derivative) const;

 private:
  struct Made;

  int threads_;
  std::unique_ptr<const VolumeFiles> files_;
  std::unique_ptr<const Made> made_;  ///< of one scene; else empty
};

}  // namespace vegard::sim
