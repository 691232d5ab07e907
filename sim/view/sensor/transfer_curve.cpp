#include "sim/view/sensor/transfer_curve.h"

#include <algorithm>
#include <cmath>

namespace vegard::sim {
namespace {

// The standard's rounded constants leave a step of 1e-8 where line and power meet. The power meets the line
// of slope 12.92 at this encoded value and its twelfth; cutting both directions at the same place keeps them
// inverse to each other.
constexpr double encoded_knee = 0.04045;
constexpr double linear_knee = encoded_knee / 12.92;

constexpr double kKnee = 0.04045;         // of sRGB, where its line meets its power
constexpr double kAtWhite = 2.4 / 1.055;  // d ln D / d v there
constexpr int kBentMaxHalvings = 200;     // far more than a double has bits
constexpr double kBentCloseEnough = 1e-13;

/// d ln D / d v of sRGB's decoding.
double srgb_log_slope(double encoded) { return encoded <= kKnee ? 1.0 / encoded : 2.4 / (encoded + 0.055); }

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

double BentSrgb::decode(double encoded) const {
  const double size = std::abs(encoded);
  const double light =
      std::pow(srgb_decode(size), black) * std::exp((white - black) * kAtWhite * (size - 1.0));
  return std::copysign(light, encoded);
}

double BentSrgb::slope(double encoded) const {
  return decode(encoded) * (black * srgb_log_slope(encoded) + (white - black) * kAtWhite);
}

double BentSrgb::encode(double linear) const {
  const double light = std::abs(linear);
  if (!(light > 0.0)) return linear;
  if (black == white) return std::copysign(srgb_encode(std::pow(light, 1.0 / black)), linear);
  // Newton's steps in the logarithm of the light, kept between brackets that close.
  double low = 0.0, high = 1.0;
  while (decode(high) < light && high < 1e6) high *= 2.0;
  double v = std::min(high, srgb_encode(std::pow(light, 2.0 / (black + white))));
  for (int i = 0; i < kBentMaxHalvings && high - low > kBentCloseEnough * high; ++i) {
    const double here = decode(v);
    (here < light ? low : high) = v;
    double next = here > 0.0 ? v - std::log(here / light) * here / slope(v) : low;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - v) <= kBentCloseEnough * v) return std::copysign(next, linear);
    v = next;
  }
  return std::copysign(v, linear);
}

}  // namespace vegard::sim
