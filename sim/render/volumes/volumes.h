// The scene's volumes on a film: footprints, nebulae and grids, marched along the rays of its cells.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "sim/base/large_vector.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

struct Scene;

struct VolumeFiles;

/// The light of volumes on a film. A ray passes several volumes in the order in which it enters them.
struct VolumeLight {
  int lines = 0;
  LargeVector<float> rayleigh;  ///< [line][row][column]
  LargeVector<float> kept;      ///< [line][row][column] transmission for the light behind; empty: 1
  LargeVector<float> depth_km;  ///< [row][column] mean distance of the light; infinity where there is none
};

/// Marches the cells of a film, [row][column], for which `wanted` is nonzero; all if it is empty. Other cells
/// are dark and hide nothing.
using MarchCells =
    std::function<VolumeLight(const FilmGeometry& film, const std::vector<std::uint8_t>& wanted)>;

/// Returns where the rays of a film end (ray_ends_km() in sim/render/emitters/volume_files.h).
using EndsOfRays = std::function<std::vector<float>(const FilmGeometry& film)>;

/// Computes the light of a film from that of a film with cells `shrink` times as wide and high
/// (sim/view/film/depth_image.h). Cells that no coarse ray represents, at the edges of objects in the
/// scene and of the lens's image circle, are marched directly.
VolumeLight march_coarsely(const FilmGeometry& film, int shrink, const EndsOfRays& ends,
                           const MarchCells& march, int threads);

/// True if the scene has volumes whose light is in rayleighs.
bool has_volumes(const Scene& scene);

/// Constructed once for a scene, whose files it reads; later scenes may differ in their parameters.
class Volumes {
 public:
  /// Throws Error(unreadable_input) for a file that is missing or cannot be used. `of_one_scene`: everything
  /// that precedes the march of rays, such as footprints, is computed in the constructor; later scenes may
  /// then differ in their camera only.
  Volumes(const Scene& scene, int threads, bool of_one_scene = false);
  ~Volumes();

  /// Returns the light, marched at the resolution of march.shrink and with several rays to cells on the Sun's
  /// limb (at the film's own and with one ray each if `whole_resolution`, as the derivatives are), with the
  /// smoothing and glow of [march]. `progress` and `stop` as in Exposer::expose().
  VolumeLight light(const Scene& scene, const FilmGeometry& film,
                    const std::function<void(double)>& progress = {}, const std::atomic<bool>* stop = nullptr,
                    bool whole_resolution = false) const;

  /// Adds the derivatives of the light at the film's own resolution with respect to `free`, parameters of the
  /// scene, to [line][row][column][stride].
  void add_light_derivatives(const Scene& scene, const FilmGeometry& film,
                             const std::vector<ParameterId>& free, std::size_t stride,
                             float* derivative) const;

  /// Returns the march without smoothing or glow, for several films of this scene. The scene must outlive it.
  MarchCells marcher(const Scene& scene, const std::function<void(double)>& progress = {},
                     const std::atomic<bool>* stop = nullptr) const;

  /// Adds the derivatives of the march without smoothing or glow.
  void add_derivatives(const Scene& scene, const FilmGeometry& film, const std::vector<ParameterId>& free,
                       std::size_t stride, float* derivative) const;

 private:
  struct Made;

  int threads_;
  std::unique_ptr<const VolumeFiles> files_;
  std::unique_ptr<const Made> made_;  ///< if made for one scene only; else null
};

}  // namespace vegard::sim
