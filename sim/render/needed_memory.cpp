#include "sim/render/needed_memory.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "sim/base/image.h"
#include "sim/base/parallel.h"
#include "sim/light/sample.h"
#include "sim/render/emitters/footprint_volumes.h"
#include "sim/render/film.h"
#include "sim/render/physical_blur.h"
#include "sim/render/slab_exposer.h"
#include "sim/render/volumes/volumes.h"
#include "sim/view/sky/night_sky.h"
#include "sim/view/sky/stars.h"

namespace vegard::sim {
namespace {

constexpr double kFloatBytes = sizeof(float), kFilmUnit = 8.0;  // of a line on a thread's film

/// Returns the bytes of a cell: on the threads' films, on the sum of them, and for volumes.
double film_bytes_of_cell(const Scene& scene, int threads) {
  const double lines = static_cast<double>(scene.emission.lines.size()), stride = lines <= 4.0 ? 4.0 : 8.0;
  double bytes = kFloatBytes * lines;
  if (!scene.sheets.empty()) bytes += threads * stride * kFilmUnit;
  // Light, what it lets through and its distance; and of a softened or coarser march a second set.
  if (has_volumes(scene)) bytes += 2.0 * kFloatBytes * (2.0 * lines + 1.0);
  return bytes;
}

double map_bytes_of_all(const Scene& scene, std::size_t number_bytes) {
  double bytes = 0.0;
  for (const Footprint& footprint : scene.footprints) bytes += map_bytes(scene, footprint, number_bytes);
  return bytes;
}

}  // namespace

double render_bytes(const Scene& scene, int threads, const RenderingUse& use) {
  const FilmGeometry film = film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 1.0, 1.0);
  const double cells = static_cast<double>(film.rows) * film.columns;
  const double pixels = static_cast<double>(scene.camera.width) * scene.camera.height;
  const double lines = static_cast<double>(scene.emission.lines.size());
  const double of_lines = kFloatBytes * lines, of_colours = 3.0 * kFloatBytes;
  const int slots = thread_count(threads);
  double film_bytes = cells * film_bytes_of_cell(scene, slots);
  if (scene.blur.model == BlurModel::physical) {
    // Beam by beam it spreads over a ladder of films, each of half the size, of one line at a time.
    if (is_spread_by_beams(scene))
      film_bytes += cells * (2.0 * kFilmUnit * slots + 4.0 * kFloatBytes);
    else
      film_bytes = cells * 2.0 * of_lines + slab_bytes(slab_plan(scene, film, slots), 0, slots);
  }
  // While the film lasts: the lines' picture, once more on its way through the blur, and the layers before
  // this one.
  const double of_sheets =
      use.sheet_layers ? static_cast<double>(scene.sheets.size()) * (of_lines + of_colours) : 0.0;
  const double exposing =
      film_bytes + pixels * (2.0 * of_lines + of_sheets) + map_bytes_of_all(scene, sizeof(double));
  // After it: lines (twice, once to be written), the aurora, and all of it together.
  double of_pixel = 2.0 * of_lines + 2.0 * of_colours + of_sheets + use.bytes_per_px;
  if (has_night_sky(scene)) of_pixel += 2.0 * of_colours;
  if (has_stars(scene)) of_pixel += of_colours;
  constexpr double kSorting = 9.0;  // a pixel's azimuth and elevation
  if (scene.ground.shown) of_pixel += of_colours + kFloatBytes + kSorting;
  if (!scene.composite.background.empty()) of_pixel += 2.0 * of_colours + kFloatBytes;
  if (!scene.composite.foreground.empty()) of_pixel += 2.0 * (of_colours + kFloatBytes);
  if (has_volumes(scene)) of_pixel += 2.0 * of_lines + 3.0 * of_colours + kFloatBytes;
  if (!scene.nebulae.empty()) of_pixel += of_colours + kFloatBytes;
  // The mean of the instants of what moves by keys lasts while each of them is rendered.
  const double mean = !scene.keys.empty() && scene.time.instants > 1 ? pixels * of_pixel : 0.0;
  return mean + std::max(exposing, pixels * of_pixel);
}

int threads_to_render(const Scene& scene, int threads, const RenderingUse& use, const MemoryLimit& limit) {
  const double program = kProgramBytes - (use.loads_codecs ? 0.0 : kCodecBytes);
  const auto bytes = [&](int count) { return program + render_bytes(scene, count, use); };
  int count = thread_count(threads);
  while (count > 1 && bytes(count) > limit.bytes) --count;
  const std::string picture =
      "a picture of " + size_text(scene.camera.width, scene.camera.height) + " pixels";
  if (map_bytes_of_all(scene, sizeof(double)) > 0.5 * bytes(count))
    require_memory(
        limit, bytes(count), picture + " with its footprints' maps",
        "a larger cell_km of footprints, fewer time.instants, or emission.lag = \"none\" need less");
  else
    require_memory(limit, bytes(count), picture, "a smaller camera.width and camera.height need less");
  return count;
}

double model_bytes(const Scene& scene, double cells, int free, int threads) {
  const double lines = static_cast<double>(scene.emission.lines.size()), of_lines = kFloatBytes * lines;
  const double width = std::max(1.0, std::ceil(free / static_cast<double>(kTangentWidth))) * kTangentWidth;
  const double of_means =
      cells * (of_lines + 6.0 * kFloatBytes + 24.0) + map_bytes_of_all(scene, sizeof(FreeDual));
  if (scene.blur.model == BlurModel::physical) {
    // The light is spread slab by slab, here on a film of as many square cells.
    FilmGeometry film;
    film.columns = film.rows = static_cast<int>(std::ceil(std::sqrt(cells)));
    film.cell_width_px = static_cast<double>(scene.camera.width) / film.columns;
    film.cell_height_px = static_cast<double>(scene.camera.height) / film.rows;
    return of_means + cells * of_lines * (width + 2.0) +
           slab_bytes(slab_plan(scene, film, threads), free, threads);
  }
  // The film with its derivatives, as shares of the beams and together; then lines, colours and weights.
  return of_means +
         cells * (film_bytes_of_cell(scene, thread_count(threads)) + of_lines * (width + kTangentWidth));
}

}  // namespace vegard::sim
