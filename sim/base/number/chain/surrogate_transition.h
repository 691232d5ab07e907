// A move of a Markov chain that many cheap steps on a surrogate of the density have proposed.
//
// From the place where the chain is, K steps of a kernel that is reversible for the surrogate lead to
// another. K such steps are reversible for it as well, so that taking the last place with the probability
// min(1, density(y) surrogate(x) / (density(x) surrogate(y))) keeps the density itself, however wrong the
// surrogate is: J. S. Liu, "Monte Carlo strategies in scientific computing" (2001), section 9.4.3; J. A.
// Christen and C. Fox, "Markov chain Monte Carlo using an approximation", Journal of Computational and
// Graphical Statistics 14 (2005) 795, doi:10.1198/106186005X76983. A dear density is asked once for K steps;
// what a wrong surrogate costs is refusals.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sim/base/number/chain/student_proposal.h"

namespace vegard::sim {

/// Logarithm of the density at some coordinates, up to a constant; -infinity where it is 0. NaN and +infinity
/// count as -infinity.
using LogDensity = std::function<double(const std::vector<double>& coordinates)>;

/// As above, for whoever calls one.
double finite_or_minus_infinity(double log_density);

/// The kernel on the surrogate: half of its steps are independent places of Student's distribution, half a
/// random walk with the covariance's shape, from an eighth of the best length for a normal density to twice
/// it (2.38 / √d: G. O. Roberts, A. Gelman, W. R. Gilks, Annals of Applied Probability 7 (1997) 110).
class SurrogateTransition {
 public:
  /// All that is referred to must outlive it.
  SurrogateTransition(const LogDensity& surrogate, const StudentProposal& student, std::uint64_t seed);

  /// Goes so many steps from `at`, which becomes the last place. Returns the logarithm of surrogate(before) /
  /// surrogate(after). A place where the surrogate has no density is not left. A pure function of the place,
  /// the seed and the numbers of the chain's step and of the walker.
  double walk(std::vector<double>& at, int steps, std::uint32_t step, std::uint32_t walker) const;

 private:
  const LogDensity& surrogate_;
  const StudentProposal& student_;
  std::uint64_t seed_;
};

}  // namespace vegard::sim
