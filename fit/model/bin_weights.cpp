#include "fit/model/bin_weights.h"

#include <cmath>

namespace vegard::fit {

sim::CellWeights bin_weights(const Photo& photo, const std::vector<std::shared_ptr<const BinGrid>>& grids,
                             const sim::FilmGeometry& film) {
  sim::CellWeights weights;
  for (const std::shared_ptr<const BinGrid>& grid : grids) {
    const Region& region = grid->region;
    const int cell = static_cast<int>(std::lround(film.cell_width_px));
    const int top = static_cast<int>(std::lround(region.y - film.y0_px));
    const int left = static_cast<int>(std::lround((region.x - film.x0_px) / cell));
    for (std::size_t bin = 0; bin < grid->bins(); ++bin) {
      weights.first_run.push_back(weights.runs.size());
      int count[3] = {0, 0, 0};
      for (std::size_t r = grid->first_run[bin]; r < grid->first_run[bin + 1]; ++r) {
        const BinGrid::Run& of_pixels = grid->runs[r];
        const int begin = of_pixels.begin - region.x, end = of_pixels.end - region.x;
        sim::CellWeights::Run run;
        run.row = top + of_pixels.y - region.y;
        run.first_column = left + begin / cell;
        run.columns = (end - 1) / cell - begin / cell + 1;
        run.first_pixels = weights.pixels.size();
        weights.pixels.resize(run.first_pixels + static_cast<std::size_t>(run.columns) * 3, 0.0f);
        float* pixels = weights.pixels.data() + run.first_pixels;
        for (int c = 0; c < 3; ++c)
          for (int x = begin; x < end; ++x) {
            if (!photo.usable[photo.linear.index(region.x + x, of_pixels.y, c)]) continue;
            pixels[(x / cell - begin / cell) * 3 + c] += 1.0f;
            ++count[c];
          }
        weights.runs.push_back(run);
      }
      for (const int pixels : count)
        weights.inverse.push_back(pixels > 0 ? 1.0f / static_cast<float>(pixels) : 0.0f);
    }
  }
  weights.first_run.push_back(weights.runs.size());
  return weights;
}

}  // namespace vegard::fit
