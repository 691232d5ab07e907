// Ridged noise, of which footprints of the source "noise" are made, in a plane and on a sphere.
#pragma once

#include <algorithm>
#include <cmath>

namespace vegard::sim {

/// Returns the height of the ridges at a place: a sum of octaves, each half as high and half as wide as the
/// one before, and high only where that one is (Musgrave's ridged multifractal, in Ebert et al., "Texturing
/// and Modeling", 3rd edition, chapter 16). noise_of(k, scale) is the noise of octave k, within -1 and 1, at
/// the place times `scale`.
template <typename NoiseOf>
double ridges(int octaves, const NoiseOf& noise_of) {
  constexpr double kFeedback = 1.5;
  double sum = 0.0, size = 1.0, scale = 1.0, weight = 1.0;
  for (int k = 0; k < octaves; ++k) {
    const double ridge = 1.0 - std::min(1.0, std::abs(noise_of(k, scale)));
    const double height = ridge * ridge * weight;
    sum += size * height;
    weight = std::min(1.0, kFeedback * height);
    size *= 0.5;
    scale *= 2.0;
  }
  return sum;
}

}  // namespace vegard::sim
