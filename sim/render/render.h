// The one call that ties the simulator together: scene in, picture out.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "sim/base/image.h"
#include "sim/render/film.h"
#include "sim/scene/scene.h"

namespace vegard::sim {

struct RenderOptions {
  int threads = 0;                          ///< 0: all cores. The picture does not depend on it.
  std::function<void(double)> progress;     ///< told the finished share, from any thread
  const std::atomic<bool>* stop = nullptr;  ///< ends the work early with an empty Rendering
};

struct Rendering {
  Image rayleigh;  ///< one channel per emission line, named by its wavelength ("6300"), blurred, in rayleighs
  Image aurora;    ///< linear RGB of the aurora alone through the sensor, signed where a line is out of gamut
  Image rgb;       ///< aurora + sky, linear, signed
  std::uint64_t deflection_points = 0;
};

/// The blurred picture of a film at one cell to a pixel (film_for()): one channel per line, in rayleighs.
Image rayleigh_image(const Scene& scene, const Exposure& exposure, int threads = 0);

/// Renders a valid scene. The same scene gives the same bytes on every run and for every number of threads.
Rendering render(const Scene& scene, const RenderOptions& options = {});

/// What a display shows: the aurora's out-of-gamut light is clipped before the sky is added, as the fit has
/// it; the sum is clipped at white and sRGB-encoded.
Image display_picture(const Scene& scene, const Rendering& rendering);

}  // namespace vegard::sim
