// Gauss-Hermite quadrature: means over a normal distribution.
#pragma once

#include <vector>

namespace vegard::sim {

/// A node in standard deviations, and its weight.
struct NormalNode {
  double place = 0.0, weight = 1.0;
};

/// Returns `count` nodes (at least one) in ascending order; the weights sum to 1. Means of polynomials up to
/// the degree 2 count - 1 are exact. The nodes are the zeros of the Hermite polynomial He, found between
/// those of the previous one (W. H. Press et al., "Numerical recipes", 2007, section 4.6).
std::vector<NormalNode> normal_nodes(int count);

}  // namespace vegard::sim
