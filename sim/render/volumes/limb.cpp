#include "sim/render/volumes/limb.h"

#include <algorithm>
#include <cstddef>

#include "sim/base/parallel.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {
namespace limb {

constexpr int kBandRows = 16;
/// Of a band's light and transmission; wide films of many lines have bands of fewer rows.
constexpr std::size_t kBandBytes = std::size_t{32} << 20;

int band_rows(const FilmGeometry& film, int lines) {
  const std::size_t row_bytes = static_cast<std::size_t>(film.columns) * kLimbRays * kLimbRays *
                                (2 * static_cast<std::size_t>(lines) + 1) * sizeof(float);
  return static_cast<int>(
      std::clamp<std::size_t>(kBandBytes / std::max<std::size_t>(row_bytes, 1), 1, kBandRows));
}

/// Radii, in the Sun's unit, of what hides: the photosphere and chromospheres that absorb.
std::vector<double> hiding_radii(const Scene& scene) {
  std::vector<double> radii{scene.sun.radius};
  for (const Chromosphere& chromosphere : scene.chromospheres)
    if (chromosphere.extinction > 0.0) radii.push_back(chromosphere.outerradius);
  return radii;
}

/// How many discs are seen at the corners of a film's cells, [row][column], of one row and one column more.
std::vector<std::uint8_t> discs_at_corners(const Scene& scene, const FilmGeometry& film, int threads) {
  const SunFrame<double> frame(scene.sun, plain_number);
  const CameraView<double> view = camera_view(scene.camera);
  const std::vector<double> radii = hiding_radii(scene);
  const std::size_t stride = static_cast<std::size_t>(film.columns) + 1;
  std::vector<std::uint8_t> discs((static_cast<std::size_t>(film.rows) + 1) * stride, 0);
  parallel_for(static_cast<std::size_t>(film.rows) + 1, threads, [&](std::size_t row, int) {
    for (std::size_t column = 0; column < stride; ++column) {
      double enu[3];
      if (!enu_of_pixel(view, film.x0_px + static_cast<double>(column) * film.cell_width_px,
                        film.y0_px + static_cast<double>(row) * film.cell_height_px, enu))
        continue;
      const SkyRay<double> ray = frame.ray(enu);
      if (!(ray.observer < 0.0)) continue;
      discs[row * stride + column] = static_cast<std::uint8_t>(std::min<std::ptrdiff_t>(
          255, std::count_if(radii.begin(), radii.end(), [&](double r) { return ray.aside < r * r; })));
    }
  });
  return discs;
}

}  // namespace limb

std::vector<std::uint8_t> limb_cells(const Scene& scene, const FilmGeometry& film, int threads) {
  if (!scene.sun.shown) return {};
  const std::vector<std::uint8_t> discs = limb::discs_at_corners(scene, film, threads);
  const std::size_t columns = film.columns, stride = columns + 1;
  std::vector<std::uint8_t> cells(columns * film.rows, 0);
  bool any = false;
  for (std::size_t row = 0; row < static_cast<std::size_t>(film.rows); ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const std::uint8_t* at = discs.data() + row * stride + column;
      cells[row * columns + column] = at[1] != at[0] || at[stride] != at[0] || at[stride + 1] != at[0];
      any = any || cells[row * columns + column] != 0;
    }
  if (!any) cells.clear();
  return cells;
}

void march_limb(const FilmGeometry& film, const std::vector<std::uint8_t>& cells, const MarchCells& march,
                VolumeLight& light) {
  constexpr int n = kLimbRays;
  const std::size_t columns = film.columns, all = columns * film.rows;
  FilmGeometry fine = film;
  fine.columns = film.columns * n;
  fine.cell_width_px = film.cell_width_px / n;
  fine.cell_height_px = film.cell_height_px / n;
  fine.turn_columns = fine.turn_rows = 0;
  const int band_rows = limb::band_rows(film, light.lines);
  for (int first = 0; first < film.rows; first += band_rows) {
    const int rows = std::min(band_rows, film.rows - first);
    const auto begin = cells.begin() + static_cast<std::ptrdiff_t>(first * columns),
               end = begin + static_cast<std::ptrdiff_t>(rows * columns);
    if (std::find(begin, end, 1) == end) continue;
    fine.rows = rows * n;
    fine.y0_px = film.y0_px + first * film.cell_height_px;
    const std::size_t stride = fine.columns, count = stride * fine.rows;
    std::vector<std::uint8_t> wanted(count, 0);
    for (std::size_t i = 0; i < count; ++i)
      wanted[i] = cells[(first + i / stride / n) * columns + i % stride / n];
    const VolumeLight parts = march(fine, wanted);
    const auto mean = [&](const LargeVector<float>& of, int line, std::size_t row, std::size_t column) {
      double sum = 0.0;
      for (int part = 0; part < n * n; ++part)
        sum += of[line * count + (row * n + part / n) * stride + column * n + part % n];
      return static_cast<float>(sum / (n * n));
    };
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row)
      for (std::size_t column = 0; column < columns; ++column) {
        const std::size_t cell = (first + row) * columns + column;
        if (!cells[cell]) continue;
        for (int l = 0; l < light.lines; ++l) {
          light.rayleigh[l * all + cell] = mean(parts.rayleigh, l, row, column);
          if (!light.kept.empty()) light.kept[l * all + cell] = mean(parts.kept, l, row, column);
        }
      }
  }
}

}  // namespace vegard::sim
