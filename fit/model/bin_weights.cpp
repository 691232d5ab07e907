#include "fit/model/bin_weights.h"

#include <cmath>

namespace vegard::fit {

sim::CellWeights bin_weights(const Photo& photo, const std::vector<std::shared_ptr<const BinGrid>>& grids,
                             const sim::FilmGeometry& film) {
  sim::CellWeights weights;
  for (const std::shared_ptr<const BinGrid>& grid : grids) {
    const Region& region = grid->region;
    const auto cell_of = [&](int x) { return static_cast<int>((x + 0.5) / film.cell_width_px); };
    const int top = static_cast<int>(std::lround((region.y - film.y0_px) / film.cell_height_px));
    const auto row_of = [&](int y) { return static_cast<int>((y - region.y + 0.5) / film.cell_height_px); };
    const int left = static_cast<int>(std::lround((region.x - film.x0_px) / film.cell_width_px));
    for (std::size_t bin = 0; bin < grid->bins(); ++bin) {
      weights.first_run.push_back(weights.runs.size());
      int count[3] = {0, 0, 0};
      for (std::size_t r = grid->first_run[bin]; r < grid->first_run[bin + 1]; ++r) {
        const BinGrid::Run& of_pixels = grid->runs[r];
        const int begin = of_pixels.begin - region.x, end = of_pixels.end - region.x;
        sim::CellWeights::Run run;
        run.row = top + row_of(of_pixels.y);
        run.first_column = left + cell_of(begin);
        run.columns = cell_of(end - 1) - cell_of(begin) + 1;
        const bool goes_on = weights.runs.size() > weights.first_run.back() &&
                             weights.runs.back().row == run.row &&
                             weights.runs.back().first_column == run.first_column &&
                             weights.runs.back().columns == run.columns;
        run.first_pixels = goes_on ? weights.runs.back().first_pixels : weights.pixels.size();
        if (!goes_on)
          weights.pixels.resize(run.first_pixels + static_cast<std::size_t>(run.columns) * 3, 0.0f);
        float* pixels = weights.pixels.data() + run.first_pixels;
        for (int c = 0; c < 3; ++c)
          for (int x = begin; x < end; ++x) {
            if (!photo.usable[photo.linear.index(region.x + x, of_pixels.y, c)]) continue;
            pixels[(cell_of(x) - cell_of(begin)) * 3 + c] += 1.0f;
            ++count[c];
          }
        if (!goes_on) weights.runs.push_back(run);
      }
      for (const int pixels : count)
        weights.inverse.push_back(pixels > 0 ? 1.0f / static_cast<float>(pixels) : 0.0f);
    }
  }
  weights.first_run.push_back(weights.runs.size());
  return weights;
}

}  // namespace vegard::fit
