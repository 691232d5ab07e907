#include "sim/view/sensor/transfer_curve.h"

#include <cmath>

namespace vegard::sim {
namespace {

// The standard's rounded constants leave a step of 1e-8 where line and power meet. The power meets the line
// of slope 12.92 at this encoded value and its twelfth; cutting both directions at the same place keeps them
// inverse to each other.
constexpr double encoded_knee = 0.04045;
constexpr double linear_knee = encoded_knee / 12.92;

}  // namespace

double srgb_encode(double linear) {
  const double size = std::abs(linear);
  const double encoded = size <= linear_knee ? 12.92 * size : 1.055 * std::pow(size, 1.0 / 2.4) - 0.055;
  return std::copysign(encoded, linear);
}

double srgb_decode(double encoded) {
  const double size = std::abs(encoded);
  const double linear = size <= encoded_knee ? size / 12.92 : std::pow((size + 0.055) / 1.055, 2.4);
  return std::copysign(linear, encoded);
}

}  // namespace vegard::sim
