#include "sim/render/picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "sim/render/film.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/film/panorama.h"

namespace vegard::sim {
namespace {

/// A line's blur in cells of so many pixels: its standard deviation, and the kernel's radius or -1.
struct BlurInCells {
  double sigma;
  int radius;

  BlurInCells(const Scene& scene, int line, double cell_px) : sigma(blur_sigma_px(scene, line) / cell_px) {
    const int radius_px = blur_radius_px(scene, line);
    radius = radius_px < 0 ? -1 : static_cast<int>(std::lround(radius_px / cell_px));
  }
  BlurKernel kernel() const { return gaussian_kernel(sigma, radius); }
  BlurKernel slope() const { return gaussian_kernel_derivative(sigma, radius); }
};

void make_room(const Scene& scene, const Window& window, Image& out) {
  if (out.width == window.columns && out.height == window.rows &&
      out.channel_names.size() == scene.emission.lines.size())
    return;
  std::vector<std::string> names;
  for (const double nm : scene.emission.lines) names.push_back(line_name(nm));
  out = Image(window.columns, window.rows, names);
}

/// Returns the blur by the line's angle, whatever blur.order is.
PlaneBlur angle_blur(const Scene& scene, const FilmGeometry& film, int line) {
  if (film.ramp_px > 0.0)
    return {BlurInCells(scene, line, film.cell_height_px).kernel(), gaussian_kernel(0.0)};
  return {BlurInCells(scene, line, film.cell_height_px).kernel(),
          BlurInCells(scene, line, film.cell_width_px).kernel()};
}

void blur_by(const std::vector<PlaneBlur>& blurs, const Scene& scene, const FilmGeometry& film,
             const float* planes, const Window& window, int threads, Image& out) {
  make_room(scene, window, out);
  blur_window(planes, film.rows, film.columns, blurs, window, out.data.data(), threads);
}

void blur_lines_on_sphere(const Scene& scene, const FilmGeometry& film, const float* planes,
                          const Window& window, int threads, Image& out) {
  make_room(scene, window, out);
  const std::size_t lines = scene.emission.lines.size(), pixels = out.data.size() / lines;
  std::vector<float> plane(pixels);
  for (std::size_t l = 0; l < lines; ++l) {
    const BlurInCells blur(scene, static_cast<int>(l), film.cell_height_px);
    blur_on_sphere(film, planes + l * film.rows * film.columns, blur.sigma, blur.radius, window, plane.data(),
                   threads);
    for (std::size_t i = 0; i < pixels; ++i) out.data[i * lines + l] = plane[i];
  }
}

}  // namespace

Window pixels_on(const FilmGeometry& film, const Camera& camera) {
  return {static_cast<int>(-film.y0_px), static_cast<int>(-film.x0_px), camera.height, camera.width};
}

Window all_of(const FilmGeometry& film) { return {0, 0, film.rows, film.columns}; }

PlaneBlur line_blur(const Scene& scene, const FilmGeometry& film, int line) {
  if (scene.blur.order == BlurOrder::rgb) return {gaussian_kernel(0.0), gaussian_kernel(0.0)};
  return angle_blur(scene, film, line);
}

Image blurred_colours(const Scene& scene, const FilmGeometry& film, const float* planes, const Window& window,
                      int threads) {
  Image lines;
  take_lines(scene, film, planes, all_of(film), threads, lines);
  const Image sharp = rgb_from_rayleigh(lines, line_colours(scene));
  const std::size_t cells = static_cast<std::size_t>(film.rows) * film.columns;
  std::vector<float> channels(cells * 3);
  std::vector<PlaneBlur> blurs;
  for (int c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < cells; ++i) channels[c * cells + i] = sharp.data[i * 3 + c];
    constexpr double kOfChannel[3] = {630.0, 557.7, 427.8};
    const auto& all = scene.emission.lines;
    const auto found = std::find(all.begin(), all.end(), kOfChannel[c]);
    blurs.push_back(found == all.end() ? PlaneBlur{gaussian_kernel(0.0), gaussian_kernel(0.0)}
                                       : angle_blur(scene, film, static_cast<int>(found - all.begin())));
  }
  Image rgb(window.columns, window.rows, {"R", "G", "B"});
  blur_window(channels.data(), film.rows, film.columns, blurs, window, rgb.data.data(), threads);
  return rgb;
}

PlaneBlur line_blur_slope(const Scene& scene, const FilmGeometry& film, int line) {
  return {BlurInCells(scene, line, film.cell_height_px).slope(),
          BlurInCells(scene, line, film.cell_width_px).slope()};
}

void blur_lines(const Scene& scene, const FilmGeometry& film, const float* planes, const Window& window,
                int threads, Image& out) {
  if (film.turn_columns > 0) return blur_lines_on_sphere(scene, film, planes, window, threads, out);
  std::vector<PlaneBlur> blurs;
  for (std::size_t l = 0; l < scene.emission.lines.size(); ++l)
    blurs.push_back(line_blur(scene, film, static_cast<int>(l)));
  blur_by(blurs, scene, film, planes, window, threads, out);
}

void take_lines(const Scene& scene, const FilmGeometry& film, const float* planes, const Window& window,
                int threads, Image& out) {
  const BlurKernel none = gaussian_kernel(0.0);
  blur_by(std::vector<PlaneBlur>(scene.emission.lines.size(), {none, none}), scene, film, planes, window,
          threads, out);
}

void form_lines(const Scene& scene, Exposure& exposure, const Window& window, int threads, Image& rayleigh) {
  dim_by_air(scene, exposure, threads);
  blur_lines(scene, exposure.geometry, exposure.rayleigh.data(), window, threads, rayleigh);
}

void form_lines(const Scene& scene, const std::vector<ParameterId>& free, Exposure& exposure,
                const Window& window, int threads, Image& rayleigh) {
  dim_by_air(scene, free, exposure, threads);
  blur_lines(scene, exposure.geometry, exposure.rayleigh.data(), window, threads, rayleigh);
}

void clip_out_of_gamut(Image& light) {
  for (float& value : light.data)
    if (!is_shown(value)) value = 0.0f;
}

}  // namespace vegard::sim
