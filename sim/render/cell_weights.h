// Weights with which the cells of a film enter means of light, and sums with these weights of light that is
// yet to be blurred along the row: the transpose of the blur.
//
// A mean may be over any set of cells: a row of a band, a strip along the elevation or along the field, a
// cell of a coarse picture. Code that uses these weights must not assume that a mean is a row.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "sim/light/sample.h"
#include "sim/view/film/blur.h"

namespace vegard::sim {

/// Sparse weights [mean][cell][channel]. A mean in a channel is the sum over its cells of pixels * light,
/// times `inverse`.
struct CellWeights {
  /// Neighbouring cells of one film row, a part of a mean.
  struct Run {
    int row = 0, first_column = 0, columns = 0;
    std::size_t first_pixels = 0;  ///< of the run's first cell, an index into `pixels`; 3 per cell
  };
  std::vector<Run> runs;               ///< mean after mean
  std::vector<std::size_t> first_run;  ///< [mean], and one more: the end of the last mean's runs
  std::vector<float> pixels;           ///< weight of a cell as a number of pixels, [cell of a run][channel]
  std::vector<float> inverse;          ///< [mean][channel]: 1 / number of pixels, 0 if there are none

  std::size_t means() const { return first_run.size() - 1; }
};

/// Sums over runs of cells light that is not yet blurred along the row: the blur is applied to the run's
/// weights instead of the light. Successive rows mostly have the same weights, so the last blurred weights of
/// each `place` are kept.
class SpreadRuns {
 public:
  SpreadRuns(const BlurKernel& across, int film_columns) : across_(across), columns_(film_columns) {}

  /// Returns the sum over the run, with these weights of its cells, of `light`, a film row [column][stride],
  /// after the blur; null if all weights are 0. The result is valid until the next call. `place`: any number
  /// that distinguishes the runs of a row.
  const float* sum(std::size_t place, const CellWeights::Run& run, const float* weights, const float* light,
                   std::size_t stride) {
    if (place >= kept_.size()) kept_.resize(place + 1);
    Spread& spread = kept_[place];
    if (spread.run_first != run.first_column ||
        spread.weights.size() != static_cast<std::size_t>(run.columns) ||
        !std::equal(weights, weights + run.columns, spread.weights.begin()))
      make(run, weights, spread);
    if (spread.dark) return nullptr;
    sum_.assign(stride, 0.0f);
    const float* from = light + spread.first * stride;
    for (std::size_t part = 0; part < stride; part += kPart) {  // the sums stay in registers
      float sum[kPart] = {};
      for (std::size_t i = 0; i < spread.wide.size(); ++i)
        for (int j = 0; j < kPart; ++j) sum[j] += spread.wide[i] * from[i * stride + part + j];
      std::copy_n(sum, kPart, sum_.begin() + static_cast<std::ptrdiff_t>(part));
    }
    return sum_.data();
  }

 private:
  static constexpr int kPart = 16;  // strides are multiples of it
  static_assert(kTangentWidth == kPart);
  struct Spread {
    int run_first = -1;
    bool dark = true;
    std::vector<float> weights, wide;  // of the run's cells; of all cells that the blur mixes into them
    std::size_t first = 0;             // first column of `wide`
  };
  void make(const CellWeights::Run& run, const float* weights, Spread& spread) const {
    const int radius = across_.radius();
    const int first = std::max(0, run.first_column - radius);
    const int end = std::min(columns_, run.first_column + run.columns + radius);
    spread.run_first = run.first_column;
    spread.weights.assign(weights, weights + run.columns);
    spread.dark = std::all_of(weights, weights + run.columns, [](float x) { return x == 0.0f; });
    spread.first = static_cast<std::size_t>(first);
    spread.wide.assign(static_cast<std::size_t>(end - first), 0.0f);
    for (int i = 0; i < run.columns; ++i) {
      if (weights[i] == 0.0f) continue;
      const int centre = run.first_column + i;
      for (int column = std::max(first, centre - radius); column < std::min(end, centre + radius + 1);
           ++column)
        spread.wide[column - first] += weights[i] * across_.weights[std::abs(column - centre)];
    }
  }

  const BlurKernel& across_;
  int columns_;
  std::vector<Spread> kept_;
  std::vector<float> sum_;
};

}  // namespace vegard::sim
