#include "sim/base/number/gauss_quadrature.h"

#include <cmath>
#include <cstddef>

namespace vegard::sim {
namespace {

/// He_n / sqrt(n!) at x, and the one before.
struct Hermite {
  double here = 1.0, before = 0.0;

  Hermite(int n, double x) {
    for (int k = 0; k < n; ++k) {
      const double next = (x * here - std::sqrt(static_cast<double>(k)) * before) / std::sqrt(k + 1.0);
      before = here;
      here = next;
    }
  }
};

}  // namespace

std::vector<NormalNode> normal_nodes(int count) {
  std::vector<double> zeros;
  for (int n = 1; n <= count; ++n) {
    // One zero lies between each two neighbours of the degree before; all lie within 2 sqrt(n).
    std::vector<double> edges = {-2.0 * std::sqrt(static_cast<double>(n))};
    edges.insert(edges.end(), zeros.begin(), zeros.end());
    edges.push_back(-edges.front());
    zeros.clear();
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
      double low = edges[i], high = edges[i + 1];
      const bool rises = Hermite(n, high).here > Hermite(n, low).here;
      for (int round = 0; round < 100; ++round) {
        const double middle = 0.5 * (low + high);
        ((Hermite(n, middle).here < 0.0) == rises ? low : high) = middle;
      }
      zeros.push_back(0.5 * (low + high));
    }
  }
  std::vector<NormalNode> nodes;
  for (const double zero : zeros) {
    const double before = Hermite(count, zero).before;
    nodes.push_back({zero, 1.0 / (count * before * before)});
  }
  return nodes;
}

}  // namespace vegard::sim
