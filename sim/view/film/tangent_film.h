// TangentFilm: the derivatives of a film.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include "sim/light/sample.h"

namespace vegard::sim {

/// Derivatives of a film by up to kTangentWidth (sim/light/sample.h) free parameters, in floats. Tiles of
/// columns are allocated when light first falls on them, so that the film of a part of an arc is small.
class TangentFilm {
 public:
  static constexpr int kTileColumns = 8;
  TangentFilm(int columns, int rows, int lines)
      : columns_(columns),
        rows_(rows),
        lines_(lines),
        tiles_((columns + kTileColumns - 1) / kTileColumns),
        lit_(tiles_.size(), nullptr) {}

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int lines() const { return lines_; }

  /// Returns [(row * kTileColumns + column in tile) * lines + line][kTangentWidth]; allocated and zeroed if
  /// needed.
  float* tile(int index) {
    if (lit_[index] == nullptr) light(index);
    return lit_[index];
  }
  const float* tile_if_any(int index) const { return lit_[index]; }

  /// Removes all light; the memory is kept.
  void clear() { std::fill(lit_.begin(), lit_.end(), nullptr); }

 private:
  struct Free {
    void operator()(float* p) const { std::free(p); }
  };
  void light(int index) {
    const std::size_t floats = static_cast<std::size_t>(rows_) * kTileColumns * lines_ * kTangentWidth;
    if (!tiles_[index]) {
      void* memory = std::aligned_alloc(64, floats * sizeof(float));
      if (memory == nullptr) throw std::bad_alloc();
      tiles_[index].reset(static_cast<float*>(memory));
    }
    std::fill_n(tiles_[index].get(), floats, 0.0f);
    lit_[index] = tiles_[index].get();
  }
  int columns_, rows_, lines_;
  std::vector<std::unique_ptr<float[], Free>> tiles_;  // all that were ever allocated
  std::vector<float*> lit_;                            // tiles in use, else null
};

}  // namespace vegard::sim
