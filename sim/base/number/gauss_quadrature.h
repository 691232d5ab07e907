// Gauss-Legendre quadrature, and Gauss-Hermite quadrature for means over a normal distribution.
#pragma once

#include <array>
#include <cmath>
#include <vector>

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

/// A node in standard deviations, and its weight.
struct NormalNode {
  double place = 0.0, weight = 1.0;
};

/// Returns `count` nodes (at least one) in ascending order; the weights sum to 1. Means of polynomials up to
/// the degree 2 count - 1 are exact. The nodes are the zeros of the Hermite polynomial He, found between
/// those of the previous one (W. H. Press et al., "Numerical recipes", 2007, section 4.6).
std::vector<NormalNode> normal_nodes(int count);

}  // namespace vegard::sim
