#include "sim/render/render.h"

#include <algorithm>

#include "sim/render/film.h"
#include "sim/scene/emission_lines.h"
#include "sim/view/blur.h"
#include "sim/view/colour.h"
#include "sim/view/sky.h"
#include "sim/view/transfer_curve.h"

namespace vegard::sim {

Image rayleigh_image(const Scene& scene, const Exposure& exposure, int threads) {
  const int width = scene.camera.width, height = scene.camera.height;
  const FilmGeometry& film = exposure.geometry;
  std::vector<std::string> names;
  for (double nm : scene.emission.lines) names.push_back(line_name(nm));
  Image image(width, height, names);
  const Window window{static_cast<int>(-film.y0_px), static_cast<int>(-film.x0_px), height, width};
  std::vector<BlurKernel> kernels;
  for (int l = 0; l < exposure.lines; ++l)
    kernels.push_back(gaussian_kernel(blur_sigma_px(scene, l), blur_radius_px(scene, l)));
  blur_window(exposure.rayleigh.data(), film.rows, film.columns, kernels, window, image.data.data(), threads);
  return image;
}

Rendering render(const Scene& scene, const RenderOptions& options) {
  const int width = scene.camera.width, height = scene.camera.height;
  const FilmGeometry film = film_for(scene, 0, 0, width, height, 1.0, 1.0);
  Exposure exposure;
  {
    Exposer exposer(scene, film, options.threads);
    exposer.expose(scene, exposure, options.progress, options.stop);
  }
  Rendering result;
  if (options.stop != nullptr && options.stop->load()) return result;
  result.deflection_points = exposure.deflection_points;

  result.rayleigh = rayleigh_image(scene, exposure, options.threads);
  result.aurora = rgb_from_rayleigh(
      result.rayleigh,
      rgb_per_kilorayleigh(scene.emission.lines, scene.sensor.primaries, scene.sensor.gain_per_kilorayleigh));
  result.rgb = result.aurora;
  add_sky(scene.sky, result.rgb);
  return result;
}

Image display_picture(const Scene& scene, const Rendering& rendering) {
  Image shown = rendering.aurora;
  for (float& value : shown.data) value = std::max(value, 0.0f);
  add_sky(scene.sky, shown);
  for (float& value : shown.data)
    value = static_cast<float>(srgb_encode(std::clamp<double>(value, 0.0, 1.0)));
  return shown;
}

}  // namespace vegard::sim
