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

/// The film that covers a picture region with a margin for the blur, not for the volumes' glow, in cells of
/// so many pixels.
FilmGeometry film_for(const Scene& scene, double x_px, double y_px, double width_px, double height_px,
                      double cell_width_px, double cell_height_px);

/// Blur by angle of a line in pixels: its width is an angle, and a pixel is hfov / width of one; or the
/// paper's, by the picture's height (blur.widths). 0 under the physical blur.
double blur_sigma_px(const Scene& scene, int line);

/// Its derivative by the camera's number that its scale depends on (scale_number).
double blur_sigma_growth_px(const Scene& scene, int line);

/// Where a line's kernel ends, in pixels: -1 for the untruncated one. The paper's supports, "21 by 21" and "5
/// by 5" pixels at sigma 4.75 and 2.0, are 2.2 and 1.25 sigma (docs/physics.md row B25).
int blur_radius_px(const Scene& scene, int line);

/// Exposes one film again and again, as a fit does. The beams' places, steps and random numbers follow from
/// the scene that it was made with and stay frozen: later scenes may differ in every continuous parameter,
/// not in their seed, sheets, layers, beams or film. Not for use by two threads at once.
///
/// Under blur.model = "physical" what it exposes is spread already as the excited atoms are.
class Exposer {
 public:
  /// `beyond` lays out dark beams past the sheets' ends, so many sheet lengths on either side, for later
  /// scenes in which the ends have moved along the line. `volumes`, if any, are the scene's, made elsewhere;
  /// else it makes them. `spreads`: by blur.model; else light stays where it is born, whatever that says.
  Exposer(const Scene& scene, const FilmGeometry& film, int threads, double beyond = 0.0,
          const BeamSampling& sampling = {}, std::shared_ptr<const Volumes> volumes = nullptr,
          bool spreads = true);
  ~Exposer();

  /// `progress`, if any, is told the finished share now and then, from any thread; `stop`, if any, ends the
  /// work early with a film that is not to be used. `only_sheet`, if not negative, lets that sheet alone
  /// shine: such exposures and the volumes' light add up to the whole one.
  void expose(const Scene& scene, Exposure& out, const std::function<void(double)>& progress = {},
              const std::atomic<bool>* stop = nullptr, int only_sheet = -1);

  /// Which sheets shine from now on, and whether volumes do. At first all do.
  void let_shine(std::vector<bool> sheets, bool volumes);

  /// By `free`, numbers of the scene. What they do to the height profile, other than by energy_kev, is not in
  /// the derivatives: see expose_profiles(). march.shrink counts as 1.
  void expose_with_derivatives(const Scene& scene, const std::vector<ParameterId>& free, Exposure& out);

  /// The light of one sheet alone, once for every height profile of `rates` ([altitude] as a line of
  /// HeightProfile has them, signed) that is put in the place of its own: planes of rayleighs in their order,
  /// with the same beams and random numbers as expose(). Light is linear in the profile, so d rate / d number
  /// gives d film / d number exactly (profile_slope() of sim/light/sheet_profile.h). Of a sheet whose energy
  /// varies along its curve a profile is one of each rung of the ladder, one behind the other
  /// (profile_slopes()). Eight profiles cost one expose(). Of a line of the scene, if it says which, they are
  /// spread as that line's atoms are.
  void expose_profiles(const Scene& scene, int sheet, const std::vector<std::vector<float>>& rates,
                       Exposure& out, int line = -1);

  /// Whether lines are spread each in its own way, as the excited atoms are.
  bool spreads() const;

  /// What expose_profiles() wants in the place of a line's profiles of a sheet whose light has ages
  /// (LightAges in sim/render/beams/light_ages.h): their shares of every interval, one interval behind the
  /// other. Those profiles themselves for any other sheet.
  std::vector<float> split_by_age(int sheet, double wavelength_nm, const std::vector<float>& rates) const;

  /// The same light computed in double by one thread; for tests.
  void expose_reference(const Scene& scene, std::vector<double>& rayleigh);

  /// Appends what one thread of expose() would splat, in its order (sim/render/beams/kernel.h); for
  /// benchmarks.
  void record_splats(const Scene& scene, SplatRecord& record);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> work_;
};

}  // namespace vegard::sim
