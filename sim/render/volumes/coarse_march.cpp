#include "sim/render/volumes/coarse_march.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/parallel.h"
#include "sim/view/film/depth_image.h"

namespace vegard::sim {

VolumeLight march_coarsely(const FilmGeometry& film, int shrink, const EndsOfRays& ends,
                           const MarchCells& march, int threads) {
  const FilmGeometry coarse = coarse_film(film, shrink);
  const VolumeLight few = march(coarse, {});
  const std::vector<float> few_ends = ends(coarse), all_ends = ends(film);
  const std::size_t cells = all_ends.size(), few_cells = few_ends.size();
  std::vector<DepthTaps> taps(cells);
  std::vector<std::uint8_t> alone(cells, 0);
  parallel_for(static_cast<std::size_t>(film.rows), threads, [&](std::size_t row, int) {
    for (int column = 0; column < film.columns; ++column) {
      const std::size_t cell = row * film.columns + column;
      if (std::isnan(all_ends[cell])) continue;
      taps[cell] = depth_taps(coarse, shrink, few_ends.data(), static_cast<int>(row), column, all_ends[cell]);
      alone[cell] = !taps[cell].matched;
    }
  });
  // The film, of which these cells are right already.
  VolumeLight light;
  if (std::find(alone.begin(), alone.end(), 1) != alone.end()) {
    light = march(film, alone);
  } else {
    light.lines = few.lines;
    light.rayleigh.assign(cells * few.lines, 0.0f);
    light.depth_km.assign(cells, std::numeric_limits<float>::infinity());
    if (!few.kept.empty()) light.kept.assign(cells * few.lines, 1.0f);
  }
  parallel_for(static_cast<std::size_t>(film.rows), threads, [&](std::size_t row, int) {
    for (std::size_t cell = row * film.columns; cell < (row + 1) * film.columns; ++cell) {
      if (!taps[cell].matched) continue;
      light.depth_km[cell] = few.depth_km[taps[cell].nearest()];
      for (int l = 0; l < few.lines; ++l) {
        light.rayleigh[l * cells + cell] = taps[cell].mean(few.rayleigh.data() + l * few_cells);
        if (!few.kept.empty())
          light.kept[l * cells + cell] = taps[cell].mean(few.kept.data() + l * few_cells);
      }
    }
  });
  return light;
}

}  // namespace vegard::sim
