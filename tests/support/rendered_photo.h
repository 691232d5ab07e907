// Photographs of a scene as the simulator renders it, for fits that are to find what is known: without noise,
// with the noise of chance, and with numbers that were made by a curve that is not sRGB's.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "fit/photo/photo.h"
#include "sim/base/number/random.h"
#include "sim/render/render.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::tests {

/// Without noise, in floats; light out of the display's gamut is clipped.
inline fit::Photo rendered_photo(const sim::Scene& scene) {
  const sim::Rendering rendering = sim::render(scene);
  fit::Photo photo;
  photo.linear = rendering.rgb;
  for (std::size_t i = 0; i < photo.linear.data.size(); ++i)
    photo.linear.data[i] += std::max(rendering.aurora.data[i], 0.0f) - rendering.aurora.data[i];
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = true;
  return photo;
}

/// What a linear EXR or float TIFF of the scene holds: signed, without noise.
inline fit::Photo linear_photo(const sim::Scene& scene) {
  fit::Photo photo;
  photo.linear = sim::render(scene).rgb;
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = false;
  photo.decoding = "linear";
  return photo;
}

/// Normal noise of one standard deviation, in linear sensor values, on every pixel and channel.
inline fit::Photo noisy_photo(const sim::Scene& scene, double noise, std::uint64_t seed) {
  fit::Photo photo = linear_photo(scene);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, noise);
  for (float& value : photo.linear.data) value += static_cast<float>(normal(random));
  return photo;
}

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
