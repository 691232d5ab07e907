#include "sim/view/film/tangent_film.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "sim/light/sample.h"

namespace vegard::sim {

TangentFilm::TangentFilm(int columns, int rows, int lines)
    : columns_(columns),
      rows_(rows),
      lines_(lines),
      tiles_((columns + kTileColumns - 1) / kTileColumns),
      lit_(tiles_.size(), nullptr) {}

void TangentFilm::Free::operator()(float* p) const { std::free(p); }

void TangentFilm::light(int index) {
  const std::size_t floats = static_cast<std::size_t>(rows_) * kTileColumns * lines_ * kTangentWidth;
  if (!tiles_[index]) {
    void* memory = std::aligned_alloc(64, floats * sizeof(float));
    if (memory == nullptr) throw std::bad_alloc();
    tiles_[index].reset(static_cast<float*>(memory));
  }
  std::fill_n(tiles_[index].get(), floats, 0.0f);
  lit_[index] = tiles_[index].get();
}

}  // namespace vegard::sim
