#include "fit/bin_weights.h"

#include <cmath>

namespace vegard::fit {

BinWeights bins_of_rows(const Photo& photo, const Region& region, int bands, const sim::FilmGeometry& film) {
  const int cell = static_cast<int>(std::lround(film.cell_width_px));
  const int top = static_cast<int>(std::lround(region.y - film.y0_px));
  const int left = static_cast<int>(std::lround((region.x - film.x0_px) / cell));
  BinWeights weights;
  for (int b = 0; b < bands; ++b) {
    const int begin = band_begin(region, bands, b) - region.x,
              end = band_begin(region, bands, b + 1) - region.x;
    for (int row = 0; row < region.height; ++row) {
      BinWeights::Run run;
      run.row = top + row;
      run.first_column = left + begin / cell;
      run.columns = (end - 1) / cell - begin / cell + 1;
      run.first_pixels = weights.pixels.size();
      weights.first_run.push_back(weights.runs.size());
      weights.pixels.resize(run.first_pixels + static_cast<std::size_t>(run.columns) * 3, 0.0f);
      float* pixels = weights.pixels.data() + run.first_pixels;
      for (int c = 0; c < 3; ++c) {
        int count = 0;
        for (int x = begin; x < end; ++x) {
          if (!photo.usable[photo.linear.index(region.x + x, region.y + row, c)]) continue;
          pixels[(x / cell - begin / cell) * 3 + c] += 1.0f;
          ++count;
        }
        weights.inverse.push_back(count > 0 ? 1.0f / static_cast<float>(count) : 0.0f);
      }
      weights.runs.push_back(run);
    }
  }
  weights.first_run.push_back(weights.runs.size());
  return weights;
}

}  // namespace vegard::fit
