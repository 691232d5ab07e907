// Gauss's quadrature of means over a normal distribution.
#pragma once

#include <vector>

namespace vegard::sim {

/// A place in standard deviations and its weight.
struct NormalNode {
  double place = 0.0, weight = 1.0;
};

/// `count` nodes, from the lowest up, at least one; the weights sum to 1. The mean of a polynomial up to the
/// degree 2 count - 1 is exact: zeros of Hermite's polynomial He, found between those of the one before (W.
/// H. Press et al., "Numerical recipes", 2007, section 4.6).
std::vector<NormalNode> normal_nodes(int count);

}  // namespace vegard::sim
