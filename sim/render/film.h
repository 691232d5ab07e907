// Exposing a film: from the scene's sheets to rayleighs per line on the film, with exact derivatives on
// request.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "sim/render/exposure.h"
#include "sim/render/volumes/volumes.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

struct SplatRecord;

/// Returns the film that covers a region of the picture, with a margin for the blur (but not for the volumes'
/// glow), in cells of `cell_width_px` by `cell_height_px` pixels.
FilmGeometry film_for(const Scene& scene, double x_px, double y_px, double width_px, double height_px,
                      double cell_width_px, double cell_height_px);

/// Returns the standard deviation of a line's blur in pixels. The blur's width is an angle, and a pixel
/// covers hfov / width; or the width is the paper's, in proportion to the picture's height (blur.widths). 0
/// under the physical blur.
double blur_sigma_px(const Scene& scene, int line);

/// Returns the derivative of blur_sigma_px() with respect to the camera's parameter that sets the picture's
/// scale (scale_number).
double blur_sigma_growth_px(const Scene& scene, int line);

/// Returns the radius at which a line's blur kernel is cut off, in pixels; -1 if it is not truncated. The
/// paper's supports, "21 by 21" and "5 by 5" pixels at sigma 4.75 and 2.0, are 2.2 and 1.25 sigma
/// (docs/physics.md row B25).
int blur_radius_px(const Scene& scene, int line);

/// Exposes one film again and again, as a fit does. The beams' places, steps and random numbers are
/// determined by the constructor's scene and stay frozen: later scenes may differ in every continuous
/// parameter, but not in their seed, sheets, layers, beams or film. Two threads must not use one Exposer at
/// once.
///
/// Under blur.model = "physical" the light that it returns is already spread by the motion of the excited
/// atoms.
class Exposer {
 public:
  /// `beyond`: dark beams are laid out past the sheets' ends, for this many sheet lengths on either side, for
  /// later scenes in which the ends have moved along the line. `volumes`: volumes of this scene that the
  /// caller has made; null: the constructor makes them. `spreads`: if false, the physical blur is not applied
  /// even where blur.model asks for it.
  Exposer(const Scene& scene, const FilmGeometry& film, int threads, double beyond = 0.0,
          const BeamSampling& sampling = {}, std::shared_ptr<const Volumes> volumes = nullptr,
          bool spreads = true);
  ~Exposer();

  /// Computes the light on the film. `progress`, if given, is called now and then with the finished share,
  /// from any thread; `stop`, if given, ends the work early, and the film must then not be used. If
  /// `only_sheet` is not negative, only that sheet emits: the exposures of all single sheets and the volumes'
  /// light add up to the whole exposure.
  void expose(const Scene& scene, Exposure& out, const std::function<void(double)>& progress = {},
              const std::atomic<bool>* stop = nullptr, int only_sheet = -1);

  /// Sets which sheets emit from now on, and whether volumes do. Initially all do.
  void let_shine(std::vector<bool> sheets, bool volumes);

  /// Computes the light and its derivatives with respect to `free`, parameters of the scene. The derivatives
  /// do not include the effect of a parameter on the height profile, except that of energy_kev: see
  /// expose_profiles(). march.shrink is taken as 1.
  void expose_with_derivatives(const Scene& scene, const std::vector<ParameterId>& free, Exposure& out);

  /// Computes the light of one sheet alone, once for every height profile in `rates`, which replaces the
  /// sheet's own profile. A profile is [altitude] as in HeightProfile and may be negative. The result has one
  /// plane of rayleighs per profile, in their order, with the same beams and random numbers as expose().
  /// Light is linear in the profile, so d rate / d parameter gives d film / d parameter exactly
  /// (profile_slope() of sim/light/sheet_profile.h). If a sheet's energy varies along its curve, a profile
  /// consists of those of all rungs of its energy ladder, one after the other (profile_slopes()). Eight
  /// profiles cost as much as one expose(). If `line` is not negative, the light is spread as that of the
  /// atoms of that line of the scene.
  void expose_profiles(const Scene& scene, int sheet, const std::vector<std::vector<float>>& rates,
                       Exposure& out, int line = -1);

  /// True if the light of each line is spread by the motion of its excited atoms.
  bool spreads() const;

  /// Converts a line's profiles of a sheet for expose_profiles(). If the sheet's light is split by age
  /// (LightAges in sim/render/beams/light_ages.h), returns the profiles' shares of every interval, one
  /// interval after the other; otherwise returns `rates` unchanged.
  std::vector<float> split_by_age(int sheet, double wavelength_nm, const std::vector<float>& rates) const;

  /// Computes the light of expose() in double precision with one thread; for tests.
  void expose_reference(const Scene& scene, std::vector<double>& rayleigh);

  /// Appends the samples that one thread of expose() would add to the film, in its order
  /// (sim/render/beams/kernel.h); for benchmarks.
  void record_splats(const Scene& scene, SplatRecord& record);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> work_;
};

}  // namespace vegard::sim
