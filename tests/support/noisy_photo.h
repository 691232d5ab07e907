// A rendered picture with the noise of chance.
#pragma once

#include <random>

#include "tests/support/rendered_photo.h"

namespace vegard::tests {

/// Normal noise of one standard deviation, in linear sensor values, on every pixel and channel.
inline fit::Photo noisy_photo(const sim::Scene& scene, double noise, std::uint64_t seed) {
  fit::Photo photo = linear_photo(scene);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, noise);
  for (float& value : photo.linear.data) value += static_cast<float>(normal(random));
  return photo;
}

}  // namespace vegard::tests
