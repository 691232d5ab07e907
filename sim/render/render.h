// The one call that ties the simulator together: scene in, picture out.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/base/image.h"
#include "sim/render/film.h"
#include "sim/render/lit_ground.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/film/composite.h"

namespace vegard::sim {

class RenderMemory;

struct RenderOptions {
  int threads = 0;                          ///< 0: all cores. The picture does not depend on it.
  std::function<void(double)> progress;     ///< called with the finished share, from any thread
  const std::atomic<bool>* stop = nullptr;  ///< true ends it early with an empty Rendering
  /// The pictures of the scene's [composite], at the camera's size; null: nothing behind or in front of the
  /// aurora.
  const CompositePictures* pictures = nullptr;
  std::uint64_t path_draw = 0;  ///< other paths of the same beams (BeamSampling in sim/render/exposure.h)
  bool sheet_layers = false;    ///< also render each sheet by itself, which doubles the work
  /// Cache between successive pictures (sim/render/render_memory.h). The picture does not depend on it.
  RenderMemory* memory = nullptr;
};

/// The light of one sheet, or one system of arcs, as if it were alone.
struct SheetLayer {
  std::string name;
  Image rayleigh;  ///< as in Rendering
  Image aurora;    ///< as in Rendering
};

struct Rendering {
  Image rayleigh;  ///< one channel per emission line, named by its wavelength ("6300"), in rayleighs, after
                   ///< extinction in the air, blurred (unless blur.order = "rgb" blurs the colours)
  Image aurora;    ///< linear RGB of the aurora alone through the sensor, signed where a line is out of gamut
  Image rgb;       ///< linear, signed: foreground + (1 - mask) (aurora + behind), where `behind` is sky +
              ///< night_sky + background + stars, of which `literal` and then `hidden` hide their shares;
              ///< between the two is `ground`
  std::uint64_t deflection_points = 0;

  Image night_sky;   ///< linear RGB of airglow, twilight, light pollution and moonlit air; empty: none
  Image background;  ///< linear RGB of the picture behind the aurora, times its gain; empty: none
  Image stars;       ///< linear RGB, with planets, the Moon and the Milky Way; empty: none
  Image ground;      ///< linear R, G, B and A, as `foreground`: the ground below the horizon; empty: none
  Image foreground;  ///< linear R, G, B times its gain and its mask, and A, the mask; empty: none
  Image volume;   ///< layer of the volumes: R, G, B, multiplied by A (sim/render/volume_layer.h); their light
                  ///< in rayleighs is in `aurora` too; empty: no volumes
  Image hidden;   ///< share of the light behind volumes that they hide, in R, G and B; empty: none
  Image literal;  ///< nebulae of the literal march (sim/render/volume_layer.h), behind the volumes; empty:
                  ///< none
  std::vector<SheetLayer> sheets;  ///< in the scene's order, if RenderOptions::sheet_layers
};

/// Returns the blurred picture of a film with one cell per pixel (film_for()): one channel per line, in
/// rayleighs.
Image rayleigh_image(const Scene& scene, const Exposure& exposure, int threads = 0);

/// Renders a valid scene; one with keys
/// (sim/scene/freedom/keyframes.h) is the mean of its instants, each of the scene as it is then: layer by
/// layer, so that where a layer hides another the product of two means stands for the mean of the product. If
/// nothing with keys moves between the instants, it is the picture of the scene at its start. The same scene
/// gives the same bytes on every run and for every number of threads.
Rendering render(const Scene& scene, const RenderOptions& options = {});

/// Returns the light of a scene's sky on the ground, by a rendering of sky_over_ground(); all 0 if it is
/// stopped.
GroundIllumination light_on_ground(const Scene& scene, const RenderOptions& options = {});

/// Returns linear RGB of the sky alone: level, gradient and curvature.
Image sky_light(const Scene& scene);

/// Returns the light that a display shows of a scene without keys, before the lens's vignetting: out-of-gamut
/// light of the aurora and of the night sky is clipped before anything is added, as in the fit.
Image shown_light(const Scene& scene, const Rendering& rendering);

/// Returns the light that falls on a sensor, before the lens's vignetting, in linear RGB. For a camera it may
/// be negative, as its colour matrix makes it from raw channels that are not; for the CIE observer, which has
/// no raw channels, it is the shown light.
Image light_on_sensor(const Scene& scene, const Rendering& rendering);

/// Returns what a display shows, without noise: the shown light with the lens's vignetting, clipped at white
/// and encoded by the scene's tone curve (sRGB by default).
Image display_picture(const Scene& scene, const Rendering& rendering);

}  // namespace vegard::sim
