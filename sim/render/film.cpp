#include "sim/render/film.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"
#include "sim/render/beam_exposer.h"
#include "sim/render/slab_exposer.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/view/sky/air.h"
#include "sim/view/sky/sky_numbers.h"

namespace vegard::sim {
namespace {

/// The paper's blur of a line, in pixels of its own pictures.
double paper_sigma_px(const Scene& scene, double wavelength_nm) {
  const auto line = find_line(scene, wavelength_nm);
  if (!line) return 0.0;
  return line->lifetime_s > 10.0 ? 4.75 : line->lifetime_s > 0.1 ? 2.0 : 0.0;
}

/// How many degrees a picture is high, of a lens that is no pinhole as on its axis.
double picture_height_deg(const Camera& camera) {
  const CameraView<double> view = camera_view(camera);
  const double height = camera.height / (view.lens.focal_px * view.lens.aspect);
  return (camera.model == LensModel::pinhole ? 2.0 * std::atan(0.5 * height) : height) / kRadiansPerDegree;
}

/// The paper's pictures are 383 pixels high over 35 degrees (docs/physics.md row B25).
double pixels_per_paper_pixel(const Camera& camera) {
  constexpr double kPaperRows = 383.0, kPaperHeight_deg = 35.0;
  return camera.height / kPaperRows * kPaperHeight_deg / picture_height_deg(camera);
}

template <class T>
std::vector<LineDepths<T>> depths_of_lines(const Scene& scene) {
  std::vector<LineDepths<T>> depths;
  for (const double nm : scene.emission.lines)
    depths.emplace_back(nm, sky_number<T>(scene, sky_aerosol_depth), sky_number<T>(scene, sky_angstrom),
                        scene.air.ozone_dobson);
  return depths;
}

/// Calls body(line, cell, transmission) for every cell of a film.
template <class T, class Body>
void for_every_cell(const Scene& scene, const AirAbove& air, const FilmGeometry& film, int threads,
                    const Body& body) {
  const SkyView<T> view(scene);
  const std::vector<LineDepths<T>> depths = depths_of_lines<T>(scene);
  parallel_for(static_cast<std::size_t>(film.rows), threads, [&](std::size_t row, int) {
    const double y = film.y0_px + (static_cast<double>(row) + 0.5) * film.cell_height_px;
    for (int column = 0; column < film.columns; ++column) {
      const T sine = view.at(film.x0_px + (column + 0.5) * film.cell_width_px, y).up;
      const Airmasses<T> through = air.towards(sine);
      for (std::size_t l = 0; l < depths.size(); ++l)
        body(l, row * film.columns + column, depths[l].transmission(through));
    }
  });
}

}  // namespace

double blur_sigma_px(const Scene& scene, int line) {
  if (scene.blur.model == BlurModel::physical) return 0.0;
  if (scene.blur.widths == BlurWidths::paper)
    return paper_sigma_px(scene, scene.emission.lines[line]) * pixels_per_paper_pixel(scene.camera);
  return scene.blur.width_deg[line] * pixels_per_degree(scene.camera);
}

double blur_sigma_growth_px(const Scene& scene, int line) {
  const double sigma = blur_sigma_px(scene, line);
  if (scene.blur.widths == BlurWidths::given || scene.camera.model != LensModel::pinhole)
    return sigma * pixels_per_degree_growth(scene.camera);
  // Both fields by the same focal length: d ln(1 / vfov) / d hfov.
  const double half_across = 0.5 * scene.camera.hfov_deg * kRadiansPerDegree,
               half_down = 0.5 * picture_height_deg(scene.camera) * kRadiansPerDegree;
  const double ratio = std::tan(half_down) / std::tan(half_across);
  const double growth = ratio * std::pow(std::cos(half_down) / std::cos(half_across), 2);
  return -sigma * growth / picture_height_deg(scene.camera);
}

int blur_radius_px(const Scene& scene, int line) {
  if (scene.blur.kernel != BlurKernelKind::paper) return -1;
  const auto known = find_line(scene, scene.emission.lines[line]);
  const double reach = known && known->lifetime_s > 10.0 ? 10.5 / 4.75 : 2.5 / 2.0;
  return static_cast<int>(reach * blur_sigma_px(scene, line));
}

FilmGeometry film_for(const Scene& scene, double x_px, double y_px, double width_px, double height_px,
                      double cell_width_px, double cell_height_px) {
  double widest = 0.0;
  for (std::size_t l = 0; l < scene.emission.lines.size(); ++l)
    widest = std::max(widest, blur_sigma_px(scene, static_cast<int>(l)));
  if (has_volumes(scene)) widest = std::hypot(widest, scene.march.smooth_px);
  const int across = static_cast<int>(std::ceil(4.0 * widest / cell_width_px)) + 2;
  const int down = static_cast<int>(std::ceil(4.0 * widest / cell_height_px)) + 2;
  FilmGeometry film;
  film.cell_width_px = cell_width_px;
  film.cell_height_px = cell_height_px;
  film.x0_px = x_px - across * cell_width_px;
  film.y0_px = y_px - down * cell_height_px;
  film.columns = static_cast<int>(std::ceil(width_px / cell_width_px)) + 2 * across;
  film.rows = static_cast<int>(std::ceil(height_px / cell_height_px)) + 2 * down;
  if (scene.camera.model == LensModel::equirectangular && width_px == scene.camera.width &&
      height_px == scene.camera.height) {
    film.turn_columns = film.columns - 2 * across;
    film.turn_rows = film.rows - 2 * down;
  }
  return film;
}

std::unique_ptr<Exposer> make_exposer(const Scene& scene, const FilmGeometry& film, int threads,
                                      double beyond, const BeamSampling& sampling,
                                      std::shared_ptr<const Volumes> volumes) {
  if (scene.blur.model == BlurModel::physical)
    return std::make_unique<SlabExposer>(scene, film, threads, beyond, sampling);
  return std::make_unique<BeamExposer>(scene, film, threads, beyond, sampling, std::move(volumes));
}

void dim_by_air(const Scene& scene, Exposure& exposure, int threads) {
  assert(exposure.free == 0);
  const AirAbove air(scene);
  if (air.none()) return;
  const std::size_t cells = exposure.cells();
  for_every_cell<double>(scene, air, exposure.geometry, threads,
                         [&](std::size_t line, std::size_t cell, double share) {
                           const std::size_t at = line * cells + cell;
                           if (!exposure.rayleigh.empty()) exposure.rayleigh[at] *= static_cast<float>(share);
                           if (exposure.volumes.lines > 0)
                             exposure.volumes.rayleigh[at] *= static_cast<float>(share);
                         });
}

void dim_by_air(const Scene& scene, const std::vector<ParameterId>& free, Exposure& exposure, int threads) {
  assert(exposure.free == static_cast<int>(free.size()));
  const AirAbove air(scene);
  if (air.none()) return;
  const std::size_t cells = exposure.cells(), stride = static_cast<std::size_t>(exposure.free_stride);
  const std::vector<int> which = sky_numbers_of(scene, free);
  for_every_cell<SkyDual>(scene, air, exposure.geometry, threads,
                          [&](std::size_t line, std::size_t cell, const SkyDual& share) {
                            float& light = exposure.rayleigh[line * cells + cell];
                            float* slopes = exposure.derivative.data() + (line * cells + cell) * stride;
                            const auto kept = static_cast<float>(share.v);
                            for (std::size_t j = 0; j < stride; ++j) slopes[j] *= kept;
                            for (std::size_t j = 0; j < which.size(); ++j)
                              if (which[j] >= 0) slopes[j] += light * static_cast<float>(share.d.t[which[j]]);
                            light *= kept;
                          });
}

std::vector<float> transmission_on_film(const Scene& scene, const FilmGeometry& film, int threads) {
  const AirAbove air(scene);
  if (air.none()) return {};
  const std::size_t cells = static_cast<std::size_t>(film.rows) * film.columns;
  std::vector<float> kept(cells * scene.emission.lines.size());
  for_every_cell<double>(scene, air, film, threads, [&](std::size_t line, std::size_t cell, double share) {
    kept[line * cells + cell] = static_cast<float>(share);
  });
  return kept;
}

void dim_picture_by_air(const Scene& scene, Image& rayleigh, int threads) {
  const AirAbove air(scene);
  if (air.none()) return;
  FilmGeometry film;
  film.columns = rayleigh.width;
  film.rows = rayleigh.height;
  for_every_cell<double>(scene, air, film, threads, [&](std::size_t line, std::size_t cell, double share) {
    rayleigh.data[cell * scene.emission.lines.size() + line] *= static_cast<float>(share);
  });
}

}  // namespace vegard::sim
