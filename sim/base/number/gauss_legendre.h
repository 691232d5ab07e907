// Gauss-Legendre quadrature.
#pragma once

#include <array>
#include <cmath>

#include "sim/base/number/constants.h"

namespace vegard::sim {

/// The N points and weights on 0 to 1 that integrate polynomials up to the degree 2 N - 1 exactly: the zeros
/// of the Legendre polynomial, by Newton's method (W. H. Press et al., "Numerical recipes", 2007, section
/// 4.6).
template <int N>
struct GaussLegendre {
  std::array<double, N> place, weight;

  GaussLegendre() {
    for (int i = 0; i < N; ++i) {
      double z = std::cos(kPi * (i + 0.75) / (N + 0.5)), slope = 1.0;
      for (int round = 0; round < 20; ++round) {
        double p = 1.0, before = 0.0;
        for (int n = 1; n <= N; ++n) {
          const double next = ((2.0 * n - 1.0) * z * p - (n - 1.0) * before) / n;
          before = p;
          p = next;
        }
        slope = N * (z * p - before) / (z * z - 1.0);
        z -= p / slope;
      }
      place[static_cast<std::size_t>(i)] = 0.5 * (1.0 - z);
      weight[static_cast<std::size_t>(i)] = 1.0 / ((1.0 - z * z) * slope * slope);
    }
  }
};

}  // namespace vegard::sim
