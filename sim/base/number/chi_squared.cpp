#include "sim/base/number/chi_squared.h"

#include <algorithm>
#include <cmath>

namespace vegard::sim {

double chi2_tail(double chi2, int degrees_of_freedom) {
  constexpr double kNoChance = 1e5;  // also of what is no number
  if (!(chi2 < kNoChance)) return 0.0;
  // The recurrence of the incomplete gamma function, from one degree of freedom or two.
  const double half = 0.5 * std::max(0.0, chi2);
  const bool odd = degrees_of_freedom % 2 != 0;
  double tail = odd ? std::erfc(std::sqrt(half)) : std::exp(-half);
  double term = odd ? std::exp(-half) * std::sqrt(half) / std::tgamma(1.5) : half * std::exp(-half);
  for (int n = odd ? 1 : 2; n < degrees_of_freedom; n += 2) {
    tail += term;
    term *= half / (0.5 * n + 1.0);
  }
  return tail;
}

}  // namespace vegard::sim
