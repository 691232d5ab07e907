#include "sim/view/film/level_ladder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/base/parallel.h"
#include "sim/scene/structs/footprint.h"

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

constexpr double kLadderNarrowestPx = 0.6;
constexpr double kOnACell = 1e-6;  // of a cell: what is nearer to a cell's centre falls on it alone

struct AxisAndVariance {
  LevelAxis axis;
  double variance_px2 = 0.0;
};

AxisAndVariance axis_of(double start_px, double cell_px, int cells, double sigma_px) {
  AxisAndVariance result;
  LevelAxis& axis = result.axis;
  double wide = cell_px;
  while (sigma_px >= 2.0 * wide * kNarrowestCells) wide *= 2.0;
  axis.cell_px = wide;
  axis.smooth = wide > cell_px;
  const double wide2 = wide * wide;
  const double splines = axis.smooth ? (kOfQuadratic + kOfCubic) * wide2 : 0.0;
  const double left_over = (sigma_px * sigma_px - splines) / wide2 - kOfBox;
  axis.kernel = gaussian_kernel(left_over > 0.0 ? std::sqrt(left_over) : 0.0);
  result.variance_px2 = splines + kernel_variance(axis.kernel) * wide2;
  const int margin = axis.kernel.radius() + 3;
  axis.start_px = start_px - margin * wide;
  axis.cells = static_cast<int>(std::ceil(cells * cell_px / wide)) + 2 * margin;
  return result;
}

FilmLevel film_level(const FilmGeometry& film, double sigma_px) {
  FilmLevel level;
  const AxisAndVariance across = axis_of(film.x0_px, film.cell_width_px, film.columns, sigma_px);
  const AxisAndVariance down = axis_of(film.y0_px, film.cell_height_px, film.rows, sigma_px);
  level.across = across.axis;
  level.down = down.axis;
  level.variance_px2 = 0.5 * (across.variance_px2 + down.variance_px2);
  return level;
}

/// The cells that a place falls on, and their weights; set() returns false if some of them are missing.
struct FallTaps {
  int first = 0, count = 0;
  float weight[3] = {1.0f, 0.0f, 0.0f};

  bool set(const LevelAxis& axis, double place_px) {
    const double place = (place_px - axis.start_px) / axis.cell_px - 0.5;
    const double nearest = std::floor(place + 0.5);
    const double off = place - nearest;
    if (axis.smooth) {
      first = static_cast<int>(nearest) - 1;
      count = 3;
      weight[0] = static_cast<float>(0.5 * (0.5 - off) * (0.5 - off));
      weight[1] = static_cast<float>(0.75 - off * off);
      weight[2] = static_cast<float>(0.5 * (0.5 + off) * (0.5 + off));
    } else if (std::abs(off) < kOnACell) {
      first = static_cast<int>(nearest);
      count = 1;
    } else {
      first = static_cast<int>(std::floor(place));
      count = 2;
      weight[1] = static_cast<float>(place - first);
      weight[0] = 1.0f - weight[1];
    }
    return place > -1e6 && place < 1e6 && first >= 0 && first + count <= axis.cells;
  }
};

/// The four cells of a cubic B-spline on which the value at a place depends, with their weights.
struct CubicTaps {
  int first = 0;
  float weight[4] = {};
};

/// Returns the taps for the centres of `places` cells of a picture or a film, of width `step_px`, the first
/// of which begins at `first_px`; the spline's cells have the width `cell_px` and begin at `start_px`.
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

/// Returns the cells that each of a film's columns or rows depends on, on a level.
std::vector<CubicTaps> level_taps(const LevelAxis& axis, double start_px, double cell_px, int cells) {
  if (axis.smooth) return cubic_taps(cells, cell_px, start_px, axis.start_px, axis.cell_px);
  std::vector<CubicTaps> all(cells);
  const int first = static_cast<int>(std::lround((start_px - axis.start_px) / axis.cell_px));
  for (int i = 0; i < cells; ++i) all[i] = {first + i, {1.0f, 0.0f, 0.0f, 0.0f}};
  return all;
}

}  // namespace

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

std::vector<FilmLevel> film_ladder(const FilmGeometry& film, double widest_px) {
  std::vector<FilmLevel> levels = {film_level(film, 0.0)};
  double sigma_px = kLadderNarrowestPx * film.cell_height_px;
  do {
    levels.push_back(film_level(film, sigma_px));
    sigma_px *= std::sqrt(std::sqrt(2.0));
  } while (levels.back().variance_px2 < widest_px * widest_px);
  return levels;
}

void splat_on_film_level(const FilmLevel& level, double x_px, double y_px, double weight, const float* light,
                         int width, float* cells) {
  FallTaps across, down;
  if (!across.set(level.across, x_px) || !down.set(level.down, y_px)) return;
  for (int r = 0; r < down.count; ++r)
    for (int c = 0; c < across.count; ++c) {
      const float share = static_cast<float>(weight) * down.weight[r] * across.weight[c];
      float* cell =
          cells + (static_cast<std::size_t>(down.first + r) * level.across.cells + across.first + c) *
                      static_cast<std::size_t>(width);
      for (int i = 0; i < width; ++i) cell[i] += share * light[i];
    }
}

void blur_level(const FilmLevel& level, int width, std::vector<float>& cells, std::vector<float>& scratch) {
  if (level.down.kernel.radius() == 0 && level.across.kernel.radius() == 0) return;
  scratch.resize(cells.size());
  blur_down(cells.data(), scratch.data(), level.down.cells, level.across.cells, width, level.down.kernel, 1);
  blur_across(scratch.data(), cells.data(), level.down.cells, level.across.cells, width, level.across.kernel,
              1);
}

void add_film_level(const FilmLevel& level, const std::vector<float>& cells, const FilmGeometry& film,
                    int width, float* planes, int threads) {
  const std::vector<CubicTaps> across =
      level_taps(level.across, film.x0_px, film.cell_width_px, film.columns);
  const std::vector<CubicTaps> down = level_taps(level.down, film.y0_px, film.cell_height_px, film.rows);
  const int taps_across = level.across.smooth ? 4 : 1, taps_down = level.down.smooth ? 4 : 1;
  const std::size_t row_size = static_cast<std::size_t>(level.across.cells) * width;
  parallel_for(static_cast<std::size_t>(film.rows), threads, [&](std::size_t y, int) {
    const CubicTaps& rows = down[y];
    const float* from = cells.data() + static_cast<std::size_t>(rows.first) * row_size;
    std::vector<float> mixed;
    if (taps_down > 1) {
      mixed.assign(row_size, 0.0f);
      for (int k = 0; k < taps_down; ++k)
        for (std::size_t i = 0; i < row_size; ++i) mixed[i] += rows.weight[k] * from[k * row_size + i];
      from = mixed.data();
    }
    float* to = planes + y * film.columns * static_cast<std::size_t>(width);
    for (int x = 0; x < film.columns; ++x, to += width) {
      const float* cell = from + static_cast<std::ptrdiff_t>(across[x].first) * width;
      for (int k = 0; k < taps_across; ++k)
        for (int i = 0; i < width; ++i)
          to[i] += across[x].weight[k] * cell[static_cast<std::ptrdiff_t>(k) * width + i];
    }
  });
}

}  // namespace vegard::sim
