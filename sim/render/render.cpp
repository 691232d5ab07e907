#include "sim/render/render.h"

#include <algorithm>
#include <utility>

#include "sim/render/film.h"
#include "sim/render/physical_blur.h"
#include "sim/scene/emission_lines.h"
#include "sim/view/blur.h"
#include "sim/view/colour.h"
#include "sim/view/sky.h"
#include "sim/view/transfer_curve.h"

namespace vegard::sim {

namespace {

/// Adds the lines to the channels of `rayleigh`, each blurred by its angle; returns the deflection points.
std::uint64_t add_lines_by_angle(const Scene& scene, const RenderOptions& options, Image& rayleigh) {
  const int width = scene.camera.width, height = scene.camera.height;
  const FilmGeometry film = film_for(scene, 0, 0, width, height, 1.0, 1.0);
  Exposure exposure;
  {
    Exposer exposer(scene, film, options.threads);
    exposer.expose(scene, exposure, options.progress, options.stop);
  }
  if (options.stop != nullptr && options.stop->load()) return 0;
  const int left = static_cast<int>(-film.x0_px), top = static_cast<int>(-film.y0_px);
  std::vector<float> down(exposure.cells()), both(exposure.cells());
  for (int l = 0; l < exposure.lines; ++l) {
    const double sigma = blur_sigma_px(scene, l);
    const BlurKernel kernel = gaussian_kernel(sigma, blur_radius_px(scene, l));
    const float* plane = exposure.rayleigh.data() + l * exposure.cells();
    blur_down(plane, down.data(), film.rows, film.columns, 1, kernel, options.threads);
    blur_across(down.data(), both.data(), film.rows, film.columns, 1, kernel, options.threads);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        rayleigh.at(x, y, l) = both[static_cast<std::size_t>(y + top) * film.columns + x + left];
  }
  return exposure.deflection_points;
}

}  // namespace

Rendering render(const Scene& scene, const RenderOptions& options) {
  std::vector<std::string> names;
  for (double nm : scene.emission.lines) names.push_back(line_name(nm));
  Image rayleigh(scene.camera.width, scene.camera.height, names);
  const std::uint64_t points =
      scene.blur.model == "physical"
          ? add_lines_physically(scene, options.threads, options.progress, options.stop, rayleigh)
          : add_lines_by_angle(scene, options, rayleigh);
  Rendering result;
  if (options.stop != nullptr && options.stop->load()) return result;
  result.deflection_points = points;
  result.rayleigh = std::move(rayleigh);
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
