// A plane flow as its grid has it, and interpolation in its layers.
#pragma once

#include <cstddef>
#include <vector>

namespace vegard::sim {

/// The displacement over a stretch of time, [row][column]: added to a cell's place it gives, in cells, the
/// place where its content came from.
struct FlowStretch {
  std::vector<double> columns, rows;
};

/// The flow's periodic grid, and its stretches in the order of time.
struct PlaneFlow {
  int columns = 0, rows = 0;  ///< 0: nothing has moved
  double west_km = 0.0, south_km = 0.0, cell_km = 1.0;
  std::vector<FlowStretch> stretches;
  /// [row][column], at the end, in the flow's own units of time (1 / its largest vorticity at the start)
  std::vector<double> velocity_east, velocity_north;
  double energy_first = 0.0, energy_last = 0.0;  ///< half the squares of the velocities, summed over cells
};

using FlowLayer = std::vector<double>;

/// Two numbers that the processor works on together.
using FlowPair = double __attribute__((vector_size(16)));

/// Cubic convolution (R. Keys, 1981) of a periodic plane, of some layers at one place at once.
class FlowCubic {
 public:
  FlowCubic(int columns, int rows) : columns_(columns), rows_(rows) {}

  /// Goes to a place for values alone.
  void look(double column, double row) {
    const int c = floor_of(column), r = floor_of(row);
    weigh(column - c, across_);
    weigh(row - r, up_);
    go_to(c - 1, r - 1);
  }
  /// Goes to a place for velocities.
  void look_for_velocity(double column, double row) {
    const int c = floor_of(column), r = floor_of(row);
    weigh(column - c, across_);
    weigh(row - r, up_);
    weigh_slope(column - c, across_slope_);
    weigh_slope(row - r, up_slope_);
    go_to(c - 1, r - 1);
  }

  double of(const FlowLayer& layer) const {
    double sum = 0.0;
    for (int j = 0; j < 4; ++j) {
      double in_row = 0.0;
      for (int i = 0; i < 4; ++i) in_row += across_[i] * layer[row_[j] + column_[i]];
      sum += up_[j] * in_row;
    }
    return sum;
  }

  /// The displacement over a stretch, of columns and of rows.
  FlowPair of(const FlowStretch& stretch) const {
    const double *const columns = stretch.columns.data(), *const rows = stretch.rows.data();
    FlowPair sum = {0.0, 0.0};
    for (int j = 0; j < 4; ++j) {
      FlowPair in_row = {0.0, 0.0};
      for (int i = 0; i < 4; ++i) {
        const std::size_t at = row_[j] + column_[i];
        in_row += across_[i] * FlowPair{columns[at], rows[at]};
      }
      sum += up_[j] * in_row;
    }
    return sum;
  }

  /// The velocity of a stream function, along columns and along rows.
  FlowPair velocity(const FlowLayer& stream) const {
    FlowPair sum = {0.0, 0.0};
    for (int j = 0; j < 4; ++j) {
      FlowPair in_row = {0.0, 0.0};
      for (int i = 0; i < 4; ++i)
        in_row += FlowPair{across_[i], across_slope_[i]} * stream[row_[j] + column_[i]];
      sum += FlowPair{-up_slope_[j], up_[j]} * in_row;
    }
    return sum;
  }

  /// Leads a place at the end of the stretches back to where it was before the first.
  void follow(const std::vector<FlowStretch>& stretches, double& column, double& row) {
    for (auto stretch = stretches.rbegin(); stretch != stretches.rend(); ++stretch) {
      look(column, row);
      const FlowPair back = of(*stretch);
      column += back[0];
      row += back[1];
    }
  }

 private:
  static int floor_of(double x) {
    const int towards_zero = static_cast<int>(x);
    return towards_zero - static_cast<int>(x < towards_zero);
  }
  /// Division takes longer than all else, and few places are off the plane.
  static int around(int i, int n) { return i >= 0 && i < n ? i : (i % n + n) % n; }
  void go_to(int column, int row) {
    int at_column = around(column, columns_), at_row = around(row, rows_);
    for (int k = 0; k < 4; ++k) {
      column_[k] = at_column;
      row_[k] = static_cast<std::size_t>(at_row) * columns_;
      if (++at_column == columns_) at_column = 0;
      if (++at_row == rows_) at_row = 0;
    }
  }
  static void weigh(double t, double w[4]) {
    w[0] = -0.5 * t * (1.0 - t) * (1.0 - t);
    w[1] = 1.0 + t * t * (1.5 * t - 2.5);
    w[2] = t * (0.5 + t * (2.0 - 1.5 * t));
    w[3] = -0.5 * t * t * (1.0 - t);
  }
  static void weigh_slope(double t, double slope[4]) {
    slope[0] = -0.5 * (1.0 - t) * (1.0 - 3.0 * t);
    slope[1] = t * (4.5 * t - 5.0);
    slope[2] = 0.5 + t * (4.0 - 4.5 * t);
    slope[3] = t * (1.5 * t - 1.0);
  }

  int columns_, rows_;
  double across_[4], up_[4], across_slope_[4], up_slope_[4];
  int column_[4];
  std::size_t row_[4];
};

}  // namespace vegard::sim
