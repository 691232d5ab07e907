// The scene's volumes on a film: footprints, nebulae and grids, marched along the rays of its cells.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "sim/base/large_vector.h"
#include "sim/scene/scene.h"
#include "sim/view/camera.h"

namespace vegard::sim {

struct VolumeFiles;

/// What volumes put on a film. A ray meets several one after the other, in the order of where it enters them.
struct VolumeLight {
  int lines = 0;
  LargeVector<float> rayleigh;  ///< [line][row][column]
  LargeVector<float> kept;      ///< [line][row][column] of the light behind; empty: all of it
  LargeVector<float> depth_km;  ///< [row][column] mean distance of the light; infinity where there is none
};

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

  /// `progress` and `stop` as in Exposer::expose().
  VolumeLight march(const Scene& scene, const FilmGeometry& film,
                    const std::function<void(double)>& progress = {},
                    const std::atomic<bool>* stop = nullptr) const;

  /// Adds the derivatives of the light by `free`, addresses of numbers inside `scene`, to
  /// [line][row][column][stride].
  void add_derivatives(const Scene& scene, const FilmGeometry& film, const std::vector<const double*>& free,
                       std::size_t stride, float* derivative) const;

 private:
  struct Made;

  int threads_;
  std::unique_ptr<const VolumeFiles> files_;
  std::unique_ptr<const Made> made_;  ///< of one scene; else empty
};

}  // namespace vegard::sim
