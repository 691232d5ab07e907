// Photographs of a scene whose numbers were made by a curve that is not sRGB's, and read as if they were.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "fit/photo/photo.h"
#include "sim/base/number/random.h"
#include "sim/view/sensor/transfer_curve.h"

namespace vegard::tests {

/// Codes of eight bits that `encode` makes of a photograph's light, noise of this standard deviation in light
/// added before; decoded as sRGB, with a curve that counts as unknown.
inline fit::Photo encoded_photo(const fit::Photo& light, const std::function<double(double)>& encode,
                                double noise, std::uint64_t seed) {
  fit::Photo photo = light;
  for (std::size_t i = 0; i < photo.linear.data.size(); ++i) {
    const auto words = sim::random_words(seed, sim::Stream::search, 1, static_cast<std::uint32_t>(i));
    const double u = (words[0] + 0.5) / 4294967296.0, v = (words[1] + 0.5) / 4294967296.0;
    const double normal = std::sqrt(-2.0 * std::log(u)) * std::cos(6.283185307179586 * v);
    const double value = std::clamp(light.linear.data[i] + noise * normal, 0.0, 1.0);
    const double code = std::round(255.0 * std::clamp(encode(value), 0.0, 1.0));
    photo.linear.data[i] = static_cast<float>(sim::srgb_decode(code / 255.0));
    photo.usable[i] = light.usable[i] && code < 255.0;
  }
  photo.floating = false;
  photo.srgb = true;
  photo.bits = 8;
  photo.unknowns = 1;
  photo.decoding = "unknown, taken as sRGB (8-bit PNG, as asked)";
  return photo;
}

}  // namespace vegard::tests
