// What a plane flow leaves dark: cells of a footprint whose content came from where nothing shines.
//
// A box of places is led back along the flow as a whole: its middle as every place is, and its size by the
// steepest that the displacement is around it. The bound is safe, so that a cell that is passed over is dark
// to the last bit.
//
// For the files of this folder only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/base/number/dual.h"
#include "sim/emit/footprint/map/flow_cubic.h"

namespace vegard::sim {

/// A box of places: its middle and half its edges, in cells of the flow.
struct FlowBox {
  double column, row, half_columns, half_rows;
};

/// Bounds of where the places of a box came from.
class FlowReach {
 public:
  explicit FlowReach(const PlaneFlow& flow) : flow_(flow) {
    block_columns_ = (flow.columns + kBlock - 1) / kBlock;
    block_rows_ = (flow.rows + kBlock - 1) / kBlock;
    for (const FlowStretch& stretch : flow.stretches) steepest_.push_back(steepest_of(stretch));
  }

  /// Returns a box that holds all places from which the content of this one came.
  FlowBox follow(FlowCubic& cubic, FlowBox box) const {
    for (std::size_t s = flow_.stretches.size(); s-- > 0;) {
      const Steepness steep = within(steepest_[s], box);
      cubic.look(box.column, box.row);
      const FlowPair back = cubic.of(flow_.stretches[s]);
      box.column += back[0];
      box.row += back[1];
      const double columns = box.half_columns, rows = box.half_rows;
      box.half_columns += kSlope * (steep.columns[0] * columns + steep.columns[1] * rows);
      box.half_rows += kSlope * (steep.rows[0] * columns + steep.rows[1] * rows);
    }
    return box;
  }

 private:
  static constexpr int kBlock = 8;
  /// The slope of a cubic convolution is at most 1.5 times the largest step between the nodes around it,
  /// along the axis, and the sum of the sizes of its weights across is at most 1.25.
  static constexpr double kSlope = 1.9;

  /// Largest steps between neighbouring nodes, along columns and along rows.
  struct Steepness {
    float columns[2] = {0.0f, 0.0f}, rows[2] = {0.0f, 0.0f};
    void take(const Steepness& other) {
      for (int a = 0; a < 2; ++a) {
        columns[a] = std::max(columns[a], other.columns[a]);
        rows[a] = std::max(rows[a], other.rows[a]);
      }
    }
  };

  std::vector<Steepness> steepest_of(const FlowStretch& stretch) const {
    std::vector<Steepness> all(static_cast<std::size_t>(block_columns_) * block_rows_);
    for (int r = 0; r < flow_.rows; ++r)
      for (int c = 0; c < flow_.columns; ++c) {
        const std::size_t here = static_cast<std::size_t>(r) * flow_.columns + c,
                          right = c + 1 < flow_.columns ? here + 1 : here + 1 - flow_.columns,
                          above = r + 1 < flow_.rows ? here + flow_.columns : static_cast<std::size_t>(c);
        const auto step = [&](const std::vector<double>& layer, std::size_t to) {
          return std::nextafter(static_cast<float>(std::fabs(layer[to] - layer[here])), 1e30f);
        };
        all[static_cast<std::size_t>(r / kBlock) * block_columns_ + c / kBlock].take(
            {{step(stretch.columns, right), step(stretch.columns, above)},
             {step(stretch.rows, right), step(stretch.rows, above)}});
      }
    return all;
  }

  /// The steepest of all blocks with a node that a place of the box may be interpolated from.
  Steepness within(const std::vector<Steepness>& all, const FlowBox& box) const {
    const auto span = [](double middle, double half, int cells, int blocks, int& first, int& count) {
      const double low = std::floor(middle - half) - 1.0, high = std::floor(middle + half) + 2.0;
      count = blocks;
      first = 0;
      if (!(high - low < cells - 2 * kBlock)) return;
      const int from = static_cast<int>(low) - static_cast<int>(std::floor(low / cells)) * cells;
      first = from / kBlock;
      // The last block of the periodic plane may be shorter than the others.
      count = std::min(blocks, static_cast<int>(high - low) / kBlock + 3);
    };
    int column, columns, row, rows;
    span(box.column, box.half_columns, flow_.columns, block_columns_, column, columns);
    span(box.row, box.half_rows, flow_.rows, block_rows_, row, rows);
    Steepness steep;
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i)
        steep.take(all[static_cast<std::size_t>((row + j) % block_rows_) * block_columns_ +
                       (column + i) % block_columns_]);
    return steep;
  }

  const PlaneFlow& flow_;
  int block_columns_, block_rows_;
  std::vector<std::vector<Steepness>> steepest_;  ///< [stretch][block]
};

/// Which cells of a footprint have light, to be asked for boxes.
class LitCells {
 public:
  template <class T>
  LitCells(const std::vector<T>& flux, int columns, int rows)
      : columns_(columns), rows_(rows), sum_(static_cast<std::size_t>(columns + 1) * (rows + 1), 0) {
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c)
        sum_[at(c + 1, r + 1)] = sum_[at(c, r + 1)] + sum_[at(c + 1, r)] - sum_[at(c, r)] +
                                 (shines(flux[static_cast<std::size_t>(r) * columns + c]) ? 1u : 0u);
  }

  /// True if there is light in a cell from `left` to `right` and `low` to `high`.
  bool any(double left, double right, double low, double high) const {
    const auto kept = [](double x, int most) { return static_cast<int>(std::clamp(x, 0.0, 1.0 * most)); };
    const int c0 = kept(std::floor(left), columns_), c1 = kept(std::ceil(right) + 1.0, columns_),
              r0 = kept(std::floor(low), rows_), r1 = kept(std::ceil(high) + 1.0, rows_);
    return sum_[at(c1, r1)] + sum_[at(c0, r0)] != sum_[at(c0, r1)] + sum_[at(c1, r0)];
  }

 private:
  static bool shines(double flux) { return flux != 0.0; }
  /// What is dark may have derivatives.
  template <class D>
  static bool shines(const Dual<double, D>&) {
    return true;
  }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * (columns_ + 1) + column;
  }

  int columns_, rows_;
  std::vector<std::uint32_t> sum_;
};

}  // namespace vegard::sim
