// The phase function: the angular distribution of scattered light.
#pragma once

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"

namespace vegard::sim {

/// L. G. Henyey and J. L. Greenstein (1941, ApJ 93, 70): phase function per steradian; `cosine` is that of
/// the angle between the directions of light before and after scattering, and g, between -1 and 1, the mean
/// cosine. Its integral over all directions is 1.
///   (1 - g²) / (4 pi (1 + g² - 2 g cosine)^(3/2))
template <class T>
T henyey_greenstein(const T& cosine, const T& g) {
  const T square = g * g, base = square + 1.0 - g * cosine * 2.0;
  return (T(1.0) - square) / (base * square_root(base)) * (1.0 / (4.0 * kPi));
}

}  // namespace vegard::sim
