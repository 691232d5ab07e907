// A tone curve as a table: from linear light to the 8-bit numbers of a display, without a power per pixel.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/base/image.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::sim {

/// For every float the number that an 8-bit picture has of it, encoded by the curve, limited to 0 to 1 and
/// rounded to the nearest step.
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

  /// [row][column][channel]
  std::vector<std::uint8_t> bytes(const Image& light, int threads) const;

 private:
  static constexpr int kCells = 4096;
  std::array<float, 257> first_;            ///< the least light that has at least this number
  std::array<std::uint8_t, kCells> least_;  ///< number of the least light of each 1 / kCells
  std::uint8_t white_;
};

}  // namespace vegard::sim
