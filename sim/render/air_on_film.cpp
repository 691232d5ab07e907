#include "sim/render/air_on_film.h"

#include <cassert>

#include "sim/base/parallel.h"
#include "sim/view/sky/air.h"
#include "sim/view/sky/sky_numbers.h"

namespace vegard::sim {
namespace {

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
