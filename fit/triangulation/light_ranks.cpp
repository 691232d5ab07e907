#include "fit/triangulation/light_ranks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vegard::fit {
namespace light_ranks {

/// The lag along a row or a column of which the autocorrelation is below a half; their length if there is
/// none.
double lag_of_half(const std::vector<double>& grid, std::size_t rows, std::size_t columns,
                   bool is_along_rows) {
  const std::size_t most = is_along_rows ? columns : rows;
  for (std::size_t lag = 1; lag < most; ++lag) {
    const std::size_t right = is_along_rows ? lag : 0, down = is_along_rows ? 0 : lag;
    double product = 0.0, square = 0.0;
    for (std::size_t row = 0; row + down < rows; ++row)
      for (std::size_t column = 0; column + right < columns; ++column) {
        const double here = grid[row * columns + column];
        const double there = grid[(row + down) * columns + column + right];
        if (std::isnan(here) || std::isnan(there)) continue;
        product += here * there;
        square += 0.5 * (here * here + there * there);
      }
    if (product < 0.5 * square) return static_cast<double>(lag);
  }
  return static_cast<double>(most);
}

}  // namespace light_ranks

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

double independent_values(const std::vector<double>& grid, std::size_t rows, std::size_t columns) {
  const auto known = std::count_if(grid.begin(), grid.end(), [](double one) { return !std::isnan(one); });
  return static_cast<double>(known) / (2.27 * light_ranks::lag_of_half(grid, rows, columns, false) *
                                       light_ranks::lag_of_half(grid, rows, columns, true));
}

}  // namespace vegard::fit
