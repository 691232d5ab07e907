// TangentFilm: the derivatives of a film.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

namespace vegard::sim {

/// Derivatives of a film by up to kTangentWidth (sim/light/sample.h) free parameters, in floats. Tiles of
/// columns are allocated when light first falls on them, so that the film of a part of an arc is small.
class TangentFilm {
 public:
  static constexpr int kTileColumns = 8;
  TangentFilm(int columns, int rows, int lines);

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
    void operator()(float* p) const;
  };
  void light(int index);
  int columns_, rows_, lines_;
  std::vector<std::unique_ptr<float[], Free>> tiles_;  // all that were ever allocated
  std::vector<float*> lit_;                            // tiles in use, else null
};

}  // namespace vegard::sim
