// The result of exposing a film, how its beams are sampled, and the interface to expose a part of a scene.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "sim/base/large_vector.h"
#include "sim/render/volumes/volumes.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// The light on a film before any blur.
struct Exposure {
  FilmGeometry geometry;
  int lines = 0;
  LargeVector<float> rayleigh;  ///< [line][row][column]
  std::uint64_t deflection_points = 0;
  VolumeLight volumes;  ///< light of the volumes alone; `rayleigh` includes it; empty without volumes

  int free = 0;         ///< number of free parameters
  int free_stride = 0;  ///< `free` rounded up to whole vector registers; the padding holds zeros
  std::vector<float>
      derivative;  ///< [line][row][column][free_stride]; rayleighs per scene unit of the parameter

  std::size_t cells() const { return static_cast<std::size_t>(geometry.rows) * geometry.columns; }
};

/// How the beams that a film is exposed to are sampled.
struct BeamSampling {
  /// Added to the scene's seed for the random numbers of beams only; the noise of volumes belongs to the
  /// scene.
  std::uint64_t draw = 0;
  /// True: computes the mean over all draws instead of one draw, by a quadrature that is fine enough for
  /// profiles of the film's rows after smoothing by `smooth_px` pixels (sim/render/beams/sheet_nodes.h).
  bool mean = false;
  double smooth_px = 0.0;
  double fineness = 1.0;  ///< factor on the density of the quadrature's nodes
  /// As `draw`, but for the random steps of beams only: the beams keep their feet and take other paths.
  std::uint64_t path_draw = 0;
};

/// Exposes a film to a part of a scene, as Exposer (sim/render/film.h) does but without any blur. SlabExposer
/// adds up such parts.
class PartExposer {
 public:
  virtual ~PartExposer() = default;
  virtual void let_shine(std::vector<bool> sheets, bool volumes) = 0;
  virtual void expose(const Scene& scene, Exposure& out, const std::function<void(double)>& progress,
                      const std::atomic<bool>* stop, int only_sheet) = 0;
  virtual void expose_with_derivatives(const Scene& scene, const std::vector<ParameterId>& free,
                                       Exposure& out) = 0;
  virtual void expose_profiles(const Scene& scene, int sheet, const std::vector<std::vector<float>>& rates,
                               Exposure& out) = 0;
  virtual std::vector<float> split_by_age(int sheet, double wavelength_nm,
                                          const std::vector<float>& rates) const = 0;
};
using MakePartExposer =
    std::function<std::unique_ptr<PartExposer>(const Scene& scene, const FilmGeometry& film)>;

}  // namespace vegard::sim
