#include "fit/triangulation/light_ranks.h"

#include <algorithm>
#include <numeric>

namespace vegard::fit {

Eigen::VectorXd ranks_of(const std::vector<double>& values) {
  const std::size_t n = values.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return values[a] != values[b] ? values[a] < values[b] : a < b;
  });
  Eigen::VectorXd rank(static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < n;) {
    std::size_t end = i;
    while (end < n && values[order[end]] == values[order[i]]) ++end;
    const double mean = 0.5 * static_cast<double>(i + end - 1);
    for (; i < end; ++i)
      rank[static_cast<Eigen::Index>(order[i])] = 2.0 * mean / static_cast<double>(n) - 1.0;
  }
  return rank;
}

double refined_maximum(const std::vector<double>& at, const std::vector<double>& value, std::size_t best) {
  if (best == 0 || best + 1 >= value.size()) return at[best];
  const double a = value[best - 1], b = value[best], c = value[best + 1];
  const double curvature = a - 2.0 * b + c;
  if (!(curvature < 0.0)) return at[best];
  return at[best] + 0.5 * (a - c) / curvature * (at[best + 1] - at[best]);
}

}  // namespace vegard::fit
