// A lookup table for a tone curve: converts linear light to 8-bit display values without a pow() per pixel.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/base/image.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::sim {

/// Maps linear light to the value of an 8-bit picture: encoded by the curve, clamped to 0 to 1 and rounded to
/// the nearest step.
class DisplayTable {
 public:
  explicit DisplayTable(const ToneCurve& tone);

  std::uint8_t operator()(float light) const {
    if (!(light > 0.0f)) return least_[0];
    if (light >= 1.0f) return white_;
    int number = least_[static_cast<int>(light * kCells)];
    while (light >= first_[number + 1]) ++number;
    return static_cast<std::uint8_t>(number);
  }

  /// Returns the values of an image, [row][column][channel].
  std::vector<std::uint8_t> bytes(const Image& light, int threads) const;

 private:
  static constexpr int kCells = 4096;
  std::array<float, 257> first_;            ///< the smallest light with at least this value
  std::array<std::uint8_t, kCells> least_;  ///< value at the lower end of each interval of 1 / kCells
  std::uint8_t white_;
};

}  // namespace vegard::sim
