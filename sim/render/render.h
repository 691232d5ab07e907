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
  const std::atomic<bool>* stop = nullptr;  ///< ends the work early with an empty Rendering
  /// The pictures of the scene's [composite], at the camera's size; none: nothing behind or before the
  /// aurora.
  const CompositePictures* pictures = nullptr;
  std::uint64_t path_draw = 0;  ///< other paths of the same beams (BeamSampling in sim/render/film.h)
  bool sheet_layers = false;    ///< each sheet by itself as well, for twice the work
  /// What is kept from one picture to the next (sim/render/render_memory.h). The picture does not depend on
  /// it.
  RenderMemory* memory = nullptr;
};

/// The light of one sheet, or one system of arcs, as if it were alone.
struct SheetLayer {
  std::string name;
  Image rayleigh;  ///< as in Rendering
  Image aurora;    ///< as in Rendering
};

struct Rendering {
  Image rayleigh;  ///< one channel per emission line, named by its wavelength ("6300"), blurred (unless
                   ///< colours are), in rayleighs, as they reach the camera: what the air takes is gone
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
  Image volume;   ///< what volumes are in all of this: R, G, B, multiplied by A (sim/render/volume_layer.h);
                  ///< their rayleighs' light is in `aurora` too; empty: no volumes
  Image hidden;   ///< share of what is behind volumes that they hide, of R, G and B; empty: none
  Image literal;  ///< nebulae of the literal march (sim/render/literal_layer.h), behind the volumes; empty:
                  ///< none
  std::vector<SheetLayer> sheets;  ///< in the scene's order, if asked for
};

/// The blurred picture of a film at one cell to a pixel (film_for()): one channel per line, in rayleighs.
Image rayleigh_image(const Scene& scene, const Exposure& exposure, int threads = 0);

/// Renders a valid scene. The same scene gives the same bytes on every run and for every number of threads.
Rendering render(const Scene& scene, const RenderOptions& options = {});

/// What a scene's sky puts on the ground, by a rendering of sky_over_ground(); nothing if it is stopped.
GroundIllumination light_on_ground(const Scene& scene, const RenderOptions& options = {});

/// Linear RGB of the sky alone: level, gradient and curvature.
Image sky_light(const Scene& scene);

/// The light that a display shows, before a lens darkens it: out-of-gamut light of the aurora and of the
/// night sky is clipped before anything is added, as the fit has it.
Image shown_light(const Scene& scene, const Rendering& rendering);

/// The light that falls on a sensor, before its lens darkens it, in linear RGB: of a camera's channels signed
/// where its matrix makes it so, since none of its raw channels is negative; of the CIE observer, who has no
/// raw channels, the shown light.
Image light_on_sensor(const Scene& scene, const Rendering& rendering);

/// What a display shows, without noise: the shown light with the lens's vignetting, clipped at white and
/// encoded by the scene's tone curve (sRGB unless it says otherwise).
Image display_picture(const Scene& scene, const Rendering& rendering);

}  // namespace vegard::sim
