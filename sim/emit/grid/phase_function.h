// To which sides light is scattered.
#pragma once

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"

namespace vegard::sim {

/// L. G. Henyey and J. L. Greenstein (1941, ApJ 93, 70): per steradian, by the cosine of the angle between
/// the directions in which light travels before and after, and its mean, g, from above -1 to below 1. Its
/// integral over all directions is 1.
///   (1 - g²) / (4 pi (1 + g² - 2 g cosine)^(3/2))
template <class T>
T henyey_greenstein(const T& cosine, const T& g) {
  const T square = g * g, base = square + 1.0 - g * cosine * 2.0;
  return (T(1.0) - square) / (base * square_root(base)) * (1.0 / (4.0 * kPi));
}

}  // namespace vegard::sim
