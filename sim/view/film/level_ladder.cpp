#include "sim/view/film/level_ladder.h"

#include <cmath>

#include "sim/base/parallel.h"

namespace vegard::sim {
namespace {

constexpr double kLevelNarrowestPx = 0.71;
constexpr double kNarrowestCells = 1.4;  // a level has at least so many cells to its width
constexpr double kOfBilinear = 1.0 / 6.0, kOfQuadratic = 1.0 / 4.0, kOfCubic = 1.0 / 3.0, kOfBox = 1.0 / 12.0;

BlurLevel level_of(int width_px, int height_px, double sigma_px) {
  BlurLevel level;
  double cell_px = 1.0;
  while (sigma_px >= 2.0 * cell_px * kNarrowestCells) cell_px *= 2.0;
  const double cell_px2 = cell_px * cell_px;
  const double splines = cell_px > 1.0 ? (kOfQuadratic + kOfCubic) * cell_px2 - kOfBilinear : 0.0;
  const double left_over = (sigma_px * sigma_px - splines) / cell_px2 - kOfBox;
  level.kernel = gaussian_kernel(sigma_px > 0.0 ? std::sqrt(left_over) : 0.0);
  level.variance_px2 = splines + kernel_variance(level.kernel) * cell_px2;
  const int margin = level.kernel.radius() + 3;
  level.film.cell_width_px = level.film.cell_height_px = cell_px;
  level.film.x0_px = level.film.y0_px = -margin * cell_px;
  level.film.columns = static_cast<int>(std::ceil(width_px / cell_px)) + 2 * margin;
  level.film.rows = static_cast<int>(std::ceil(height_px / cell_px)) + 2 * margin;
  return level;
}

}  // namespace

std::vector<CubicTaps> cubic_taps(int places, double step_px, double first_px, double start_px,
                                  double cell_px) {
  std::vector<CubicTaps> all(places);
  for (int i = 0; i < places; ++i) {
    const double place = (first_px + (i + 0.5) * step_px - start_px) / cell_px - 0.5,
                 below = std::floor(place);
    const double t = place - below, s = 1.0 - t;
    all[i].first = static_cast<int>(below) - 1;
    all[i].weight[0] = static_cast<float>(s * s * s / 6.0);
    all[i].weight[1] = static_cast<float>((4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0);
    all[i].weight[2] = static_cast<float>((4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0);
    all[i].weight[3] = static_cast<float>(t * t * t / 6.0);
  }
  return all;
}

std::vector<BlurLevel> level_ladder(int width_px, int height_px, double widest_px) {
  std::vector<BlurLevel> levels = {level_of(width_px, height_px, 0.0)};
  double sigma_px = kLevelNarrowestPx;
  do {
    levels.push_back(level_of(width_px, height_px, sigma_px));
    sigma_px *= std::sqrt(2.0);
  } while (levels.back().variance_px2 < widest_px * widest_px);
  return levels;
}

void add_level(const BlurLevel& level, std::vector<float>& cells, Image& picture, int channel, int threads) {
  const FilmGeometry& film = level.film;
  if (level.kernel.radius() > 0) {
    std::vector<float> down(cells.size());
    blur_down(cells.data(), down.data(), film.rows, film.columns, 1, level.kernel, threads);
    blur_across(down.data(), cells.data(), film.rows, film.columns, 1, level.kernel, threads);
  }
  if (!level.smooth()) {
    const int left = static_cast<int>(-film.x0_px), top = static_cast<int>(-film.y0_px);
    parallel_for(static_cast<std::size_t>(picture.height), threads, [&](std::size_t y, int) {
      const float* row = cells.data() + (y + top) * film.columns + left;
      for (int x = 0; x < picture.width; ++x) picture.at(x, static_cast<int>(y), channel) += row[x];
    });
    return;
  }
  const std::vector<CubicTaps> across = cubic_taps(picture.width, 1.0, 0.0, film.x0_px, film.cell_width_px);
  const std::vector<CubicTaps> down = cubic_taps(picture.height, 1.0, 0.0, film.y0_px, film.cell_height_px);
  const auto per_pixel = static_cast<float>(1.0 / (film.cell_width_px * film.cell_height_px));
  parallel_for(static_cast<std::size_t>(picture.height), threads, [&](std::size_t y, int) {
    const CubicTaps& rows = down[y];
    const float* from = cells.data() + static_cast<std::ptrdiff_t>(rows.first) * film.columns;
    std::vector<float> row(film.columns);
    for (int c = 0; c < film.columns; ++c) {
      float sum = 0.0f;
      for (int k = 0; k < 4; ++k)
        sum += rows.weight[k] * from[static_cast<std::ptrdiff_t>(k) * film.columns + c];
      row[c] = sum * per_pixel;
    }
    for (int x = 0; x < picture.width; ++x) {
      const float* c = row.data() + across[x].first;
      const float* w = across[x].weight;
      picture.at(x, static_cast<int>(y), channel) += w[0] * c[0] + w[1] * c[1] + w[2] * c[2] + w[3] * c[3];
    }
  });
}

}  // namespace vegard::sim
