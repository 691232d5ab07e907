// Exposing a film: the result, how its beams are sampled, and the interface.
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
  /// Set before: volumes are marched by one ray to each cell, as expose_with_derivatives() marches them.
  bool one_ray = false;

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

/// Exposes one film again and again, as a fit does: from the scene's emitters to rayleighs per line on the
/// film, with exact derivatives on request. The beams' places, steps and random numbers are determined by
/// make_exposer()'s scene and stay frozen: later scenes may differ in every continuous parameter, but not in
/// their seed, sheets, layers, beams or film. Two threads must not use one Exposer at once.
class Exposer {
 public:
  virtual ~Exposer() = default;

  /// Computes the light on the film. `progress`, if given, is called now and then with the finished share,
  /// from any thread; `stop`, if given, ends the work early, and the film must then not be used. If
  /// `only_sheet` is not negative, only that sheet emits: the exposures of all single sheets and the volumes'
  /// light add up to the whole exposure.
  virtual void expose(const Scene& scene, Exposure& out, const std::function<void(double)>& progress = {},
                      const std::atomic<bool>* stop = nullptr, int only_sheet = -1) = 0;

  /// Computes the light and its derivatives with respect to `free`, parameters of the scene. The derivatives
  /// do not include the effect of a parameter on the height profile, except that of energy_kev: see
  /// expose_profiles(). march.shrink is taken as 1.
  virtual void expose_with_derivatives(const Scene& scene, const std::vector<ParameterId>& free,
                                       Exposure& out) = 0;

  /// Computes the light of one sheet alone, once for every height profile in `rates`, which replaces the
  /// sheet's own profile. A profile is [altitude] as in HeightProfile and may be negative. The result has one
  /// plane of rayleighs per profile, in their order, with the same beams and random numbers as expose().
  /// Light is linear in the profile, so d rate / d parameter gives d film / d parameter exactly
  /// (profile_slope() of sim/light/sheet_profile.h). If a sheet's energy varies along its curve, a profile
  /// consists of those of all rungs of its energy ladder, one after the other (profile_slopes()). Eight
  /// profiles cost as much as one expose(). If `line` is not negative, the light is spread as that of the
  /// atoms of that line of the scene.
  virtual void expose_profiles(const Scene& scene, int sheet, const std::vector<std::vector<float>>& rates,
                               Exposure& out, int line = -1) = 0;

  /// Converts a line's profiles of a sheet for expose_profiles(). If the sheet's light is split by age
  /// (LightAges in sim/render/beams/light_ages.h), returns the profiles' shares of every interval, one
  /// interval after the other; otherwise returns `rates` unchanged.
  virtual std::vector<float> split_by_age(int sheet, double wavelength_nm,
                                          const std::vector<float>& rates) const = 0;

  /// True if the light of each line is spread by the motion of its excited atoms.
  virtual bool spreads() const = 0;
};

/// Makes the exposer of a scene: a SlabExposer (sim/render/slab_exposer.h) under blur.model = "physical",
/// else a BeamExposer (sim/render/beam_exposer.h). `beyond`: dark beams are laid out past the sheets' ends,
/// for this many sheet lengths on either side, for later scenes in which the ends have moved along the line.
/// `volumes`: volumes of this scene that the caller has made; null: they are made as they are needed.
std::unique_ptr<Exposer> make_exposer(const Scene& scene, const FilmGeometry& film, int threads,
                                      double beyond = 0.0, const BeamSampling& sampling = {},
                                      std::shared_ptr<const Volumes> volumes = nullptr);

}  // namespace vegard::sim
