// A move of a Markov chain whose proposal is made by many cheap steps on a surrogate of the density.
//
// From the position x of the chain, K steps of a kernel that is reversible for the surrogate lead to a
// position y. K such steps are also reversible for the surrogate. Accepting y with the probability min(1,
// density(y) surrogate(x) / (density(x) surrogate(y))) therefore leaves the density invariant, however wrong
// the surrogate is: J. S. Liu, "Monte Carlo strategies in scientific computing" (2001), section 9.4.3; J. A.
// Christen and C. Fox, "Markov chain Monte Carlo using an approximation", Journal of Computational and
// Graphical Statistics 14 (2005) 795, doi:10.1198/106186005X76983. An expensive density is evaluated once for
// K steps; a wrong surrogate only leads to more rejections.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sim/base/number/chain/student_proposal.h"

namespace vegard::sim {

/// Logarithm of the density at some coordinates, up to a constant; -infinity where it is 0. NaN and +infinity
/// count as -infinity.
using LogDensity = std::function<double(const std::vector<double>& coordinates)>;

/// Returns the value of a LogDensity with NaN and +infinity replaced by -infinity.
double finite_or_minus_infinity(double log_density);

/// The kernel on the surrogate: half of its steps are independent samples of Student's distribution, half a
/// random walk with the covariance's shape and lengths from an eighth to twice the optimum for a normal
/// density (2.38 / √d: G. O. Roberts, A. Gelman, W. R. Gilks, Annals of Applied Probability 7 (1997) 110).
class SurrogateTransition {
 public:
  /// The references must outlive the object.
  SurrogateTransition(const LogDensity& surrogate, const StudentProposal& student, std::uint64_t seed);

  /// Makes `steps` steps from `at`, which becomes the last position. Returns the logarithm of
  /// surrogate(before) / surrogate(after). A position where the surrogate is 0 is not left. A pure function
  /// of the position, the seed, and the numbers of the chain's step and of the walker.
  double walk(std::vector<double>& at, int steps, std::uint32_t step, std::uint32_t walker) const;

 private:
  const LogDensity& surrogate_;
  const StudentProposal& student_;
  std::uint64_t seed_;
};

}  // namespace vegard::sim
