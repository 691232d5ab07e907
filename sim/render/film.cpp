#include "sim/render/film.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/render/beam_exposer.h"
#include "sim/render/slab_exposer.h"
#include "sim/scene/lines/scene_lines.h"

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

/// Of the paper's pictures, which are 383 pixels high over 35 degrees (docs/physics.md row B25).
double pixels_per_paper_pixel(const Camera& camera) {
  constexpr double kPaperRows = 383.0, kPaperHeight_deg = 35.0;
  return camera.height / kPaperRows * kPaperHeight_deg / picture_height_deg(camera);
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

}  // namespace vegard::sim
