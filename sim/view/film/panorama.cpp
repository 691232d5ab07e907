#include "sim/view/film/panorama.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"

namespace vegard::sim {
namespace {

struct TurnMargin {
  int columns, rows;
  explicit TurnMargin(const FilmGeometry& film)
      : columns(static_cast<int>(std::lround(-film.x0_px / film.cell_width_px))),
        rows(static_cast<int>(std::lround(-film.y0_px / film.cell_height_px))) {}
};

int whole_remainder(int number, int period) {
  const int rest = number % period;
  return rest < 0 ? rest + period : rest;
}

/// Returns the row within the panorama that a row beyond a pole mirrors, and whether it is half a turn on.
int row_within(int row, int rows, bool& turned) {
  const int place = whole_remainder(row, 2 * rows);
  turned = place >= rows;
  return turned ? 2 * rows - 1 - place : place;
}

double width_within(int row, int rows) {
  const double first = kPi * (static_cast<double>(row) / rows - 0.5),
               last = kPi * (static_cast<double>(row + 1) / rows - 0.5);
  return (std::sin(last) - std::sin(first)) * rows / kPi;
}

/// The sky about a pole on a plane of its own (azimuthal, equidistant), where a blur is a blur. It serves the
/// rows close to a pole, where rows and columns are no guide.
class PolarCap {
 public:
  PolarCap(const FilmGeometry& film, const float* plane, double sigma_rows, int radius, bool at_lower_pole)
      : columns_(film.turn_columns), rows_(film.turn_rows), lower_(at_lower_pole) {
    const int inside = static_cast<int>(std::ceil(kCapSigmas * sigma_rows)),
              all = inside + static_cast<int>(std::ceil(4.0 * sigma_rows)) + 1;
    if (sigma_rows < kMinSigma || 2 * all > rows_) return;
    inside_ = inside;
    half_ = (all + 1) * kFine;
    const int size = 2 * half_;
    std::vector<float> light(static_cast<std::size_t>(size) * size, 0.0f), area = light;
    const TurnMargin margin(film);
    for (int row = 0; row < all; ++row) {
      const float* from =
          plane + static_cast<std::size_t>((lower_ ? rows_ - 1 - row : row) + margin.rows) * film.columns +
          margin.columns;
      const int across = std::max(
          1, static_cast<int>(std::ceil(kFine * std::sin((row + 1) * kPi / rows_) * 2.0 * rows_ / columns_)));
      for (int i = 0; i < kFine * across * columns_; ++i) {
        const double off_pole = row + (i % kFine + 0.5) / kFine;
        const double turn = kTwoPi * (i / kFine + 0.5) / (across * columns_);
        const double share = std::sin(off_pole * kPi / rows_) / across;
        const double x = half_ + kFine * off_pole * std::cos(turn),
                     y = half_ + kFine * off_pole * std::sin(turn);
        spread(light, x, y, share * from[i / kFine / across]);
        spread(area, x, y, share);
      }
    }
    // The plane's own cells smooth too, coming and going: a sixth of a cell squared each time.
    const double sigma = std::sqrt(std::max(0.0, std::pow(sigma_rows * kFine, 2) - 1.0 / 3.0));
    const BlurKernel kernel = gaussian_kernel(sigma, radius < 0 ? -1 : radius * kFine);
    for (std::vector<float>* grid : {&light, &area}) {
      std::vector<float> down(grid->size());
      blur_down(grid->data(), down.data(), size, size, 1, kernel, 1);
      blur_across(down.data(), grid->data(), size, size, 1, kernel, 1);
    }
    for (std::size_t i = 0; i < light.size(); ++i) light[i] = area[i] > 0.0f ? light[i] / area[i] : 0.0f;
    light_ = std::move(light);
  }

  /// Returns whether the cap serves this row within the turn.
  bool has(int row) const { return off_pole(row) < inside_; }

  float at(int row, int column) const {
    const double off = kFine * (off_pole(row) + 0.5), turn = kTwoPi * (column + 0.5) / columns_;
    const double x = half_ + off * std::cos(turn) - 0.5, y = half_ + off * std::sin(turn) - 0.5;
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const double right = x - i, below = y - j;
    const float* cell = light_.data() + static_cast<std::size_t>(j) * 2 * half_ + i;
    return static_cast<float>((1.0 - below) * ((1.0 - right) * cell[0] + right * cell[1]) +
                              below * ((1.0 - right) * cell[2 * half_] + right * cell[2 * half_ + 1]));
  }

 private:
  static constexpr double kCapSigmas = 8.0, kMinSigma = 0.75;
  static constexpr int kFine = 4;  // cells to a row

  int off_pole(int row) const { return lower_ ? rows_ - 1 - row : row; }

  void spread(std::vector<float>& grid, double x_edge, double y_edge, double light) const {
    const double x = x_edge - 0.5, y = y_edge - 0.5;
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const double right = x - i, below = y - j;
    float* cell = grid.data() + static_cast<std::size_t>(j) * 2 * half_ + i;
    cell[0] += static_cast<float>(light * (1.0 - right) * (1.0 - below));
    cell[1] += static_cast<float>(light * right * (1.0 - below));
    cell[2 * half_] += static_cast<float>(light * (1.0 - right) * below);
    cell[2 * half_ + 1] += static_cast<float>(light * right * below);
  }

  int columns_, rows_, inside_ = 0, half_ = 0;
  bool lower_;
  std::vector<float> light_;
};

}  // namespace

double width_of_row(const FilmGeometry& film, int row) {
  bool turned = false;
  return width_within(row_within(row - TurnMargin(film).rows, film.turn_rows, turned), film.turn_rows);
}

CellWithin cell_within(const FilmGeometry& film, int row, int column) {
  const TurnMargin margin(film);
  bool turned = false;
  const int within = row_within(row - margin.rows, film.turn_rows, turned);
  const int along = column - margin.columns + (turned ? film.turn_columns / 2 : 0);
  return {within + margin.rows, whole_remainder(along, film.turn_columns) + margin.columns};
}

template <class T>
void close_turn(const FilmGeometry& film, T* plane) {
  const TurnMargin margin(film);
  const auto is_within = [&](int row, int column) {
    return row >= margin.rows && row < margin.rows + film.turn_rows && column >= margin.columns &&
           column < margin.columns + film.turn_columns;
  };
  const auto at = [&](int row, int column) -> T& {
    return plane[static_cast<std::size_t>(row) * film.columns + column];
  };
  for (const bool fills : {false, true}) {
    for (int row = 0; row < film.rows; ++row)
      for (int column = 0; column < film.columns; ++column) {
        if (is_within(row, column)) continue;
        const CellWithin within = cell_within(film, row, column);
        if (fills)
          at(row, column) = at(within.row, within.column);
        else
          at(within.row, within.column) += at(row, column);
      }
    if (fills) return;
    for (int row = margin.rows; row < margin.rows + film.turn_rows; ++row) {
      const T wider = static_cast<T>(1.0 / width_of_row(film, row));
      for (int column = margin.columns; column < margin.columns + film.turn_columns; ++column)
        at(row, column) *= wider;
    }
  }
}
template void close_turn(const FilmGeometry& film, float* plane);
template void close_turn(const FilmGeometry& film, double* plane);

void blur_on_sphere(const FilmGeometry& film, const float* plane, double sigma_rows, int radius,
                    const Window& window, float* out, int threads) {
  const TurnMargin margin(film);
  const int columns = film.turn_columns, rows = film.turn_rows;
  const BlurKernel down = gaussian_kernel(sigma_rows, radius);
  const int reach = down.radius();
  // With as many rows beyond the poles as the blur reaches.
  const std::size_t pitch = static_cast<std::size_t>(columns);
  std::vector<float> wide(pitch * (rows + 2 * reach));
  parallel_for(static_cast<std::size_t>(rows), threads, [&](std::size_t row, int) {
    const float* from = plane + (row + margin.rows) * film.columns + margin.columns;
    float* to = wide.data() + (row + reach) * pitch;
    const double narrower = columns / (2.0 * rows) / width_within(static_cast<int>(row), rows);
    // Where the kernel goes around a row more than once, the row is the same everywhere.
    const double sigma = sigma_rows * narrower;
    if (sigma > columns / 4.0) {
      double sum = 0.0;
      for (int column = 0; column < columns; ++column) sum += from[column];
      std::fill(to, to + columns, static_cast<float>(sum / columns));
      return;
    }
    const BlurKernel across =
        gaussian_kernel(sigma, radius < 0 ? -1 : static_cast<int>(std::lround(radius * narrower)));
    const int aside = across.radius();
    std::vector<float> turn(pitch + 2 * aside), blurred(turn.size());
    for (int i = 0; i < static_cast<int>(turn.size()); ++i)
      turn[i] = from[whole_remainder(i - aside, columns)];
    blur_across(turn.data(), blurred.data(), 1, static_cast<int>(turn.size()), 1, across, 1);
    std::copy_n(blurred.begin() + aside, columns, to);
  });
  for (int row = -reach; row < rows + reach; ++row) {
    if (row >= 0 && row < rows) continue;
    bool turned = false;
    const float* from = wide.data() + static_cast<std::size_t>(row_within(row, rows, turned) + reach) * pitch;
    float* to = wide.data() + static_cast<std::size_t>(row + reach) * pitch;
    for (int column = 0; column < columns; ++column)
      to[column] = from[(column + (turned ? columns / 2 : 0)) % columns];
  }
  const PolarCap upper(film, plane, sigma_rows, radius, false), lower(film, plane, sigma_rows, radius, true);
  parallel_for(static_cast<std::size_t>(window.rows), threads, [&](std::size_t y, int) {
    std::vector<float> blurred(pitch);
    const int row_of_film = window.first_row + static_cast<int>(y);
    const int row = cell_within(film, row_of_film, margin.columns).row - margin.rows;
    const PolarCap* cap = upper.has(row) ? &upper : lower.has(row) ? &lower : nullptr;
    if (cap == nullptr)
      blur_down_row(wide.data(), blurred.data(), rows + 2 * reach, columns, 1, down, row + reach);
    else
      for (int column = 0; column < columns; ++column) blurred[column] = cap->at(row, column);
    for (int x = 0; x < window.columns; ++x) {
      const CellWithin within = cell_within(film, row_of_film, window.first_column + x);
      out[y * window.columns + x] = blurred[within.column - margin.columns];
    }
  });
}

}  // namespace vegard::sim
