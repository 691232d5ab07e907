#include "sim/view/sensor/display_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/parallel.h"

namespace vegard::sim {
namespace {

int number_of(const ToneCurve& tone, float light) {
  const auto encoded = static_cast<float>(tone.encode(std::clamp<double>(light, 0.0, 1.0)));
  return static_cast<int>(std::lround(std::clamp(static_cast<double>(encoded), 0.0, 1.0) * 255.0));
}

}  // namespace

DisplayTable::DisplayTable(const ToneCurve& tone) : white_(static_cast<std::uint8_t>(number_of(tone, 1.0f))) {
  first_.fill(std::numeric_limits<float>::infinity());
  first_[0] = 0.0f;
  for (int number = 1; number <= white_; ++number) {
    // The curve increases, so that halving finds the least float.
    float below = 0.0f, at_least = 1.0f;
    if (number_of(tone, 0.0f) >= number) at_least = 0.0f;
    while (std::nextafter(below, 1.0f) < at_least) {
      const float middle = 0.5f * (below + at_least);
      (number_of(tone, middle) >= number ? at_least : below) = middle;
    }
    first_[number] = at_least;
  }
  for (int cell = 0, number = 0; cell < kCells; ++cell) {
    const float light = static_cast<float>(cell) / kCells;
    while (light >= first_[number + 1]) ++number;
    least_[cell] = static_cast<std::uint8_t>(number);
  }
}

std::vector<std::uint8_t> DisplayTable::bytes(const Image& light, int threads) const {
  std::vector<std::uint8_t> all(light.data.size());
  const std::size_t of_row = static_cast<std::size_t>(light.width) * light.channels();
  parallel_for(static_cast<std::size_t>(light.height), threads, [&](std::size_t row, int) {
    for (std::size_t i = row * of_row; i < (row + 1) * of_row; ++i) all[i] = (*this)(light.data[i]);
  });
  return all;
}

}  // namespace vegard::sim
