#include "sim/base/number/distance_transform.h"

#include <cassert>
#include <cstddef>

#include "sim/base/parallel.h"

namespace vegard::sim {
namespace {

constexpr std::int64_t kFar = 1 << 20;  ///< down a column without a mark: beyond what any row can reach
constexpr int kColumnsPerTask = 64;

/// Cells from each cell of a column to the nearest mark in it.
void down_columns(const std::vector<std::uint8_t>& marked, int columns, int rows, int threads,
                  std::vector<std::uint32_t>& distance) {
  const std::size_t tasks = (columns + kColumnsPerTask - 1) / kColumnsPerTask;
  parallel_for(tasks, threads, [&](std::size_t task, int) {
    const int first = static_cast<int>(task) * kColumnsPerTask;
    const int end = first + kColumnsPerTask < columns ? first + kColumnsPerTask : columns;
    const auto step = [&](int row, int from_row) {
      for (int c = first; c < end; ++c) {
        const std::size_t at = static_cast<std::size_t>(row) * columns + c;
        const std::uint32_t nearest = distance[static_cast<std::size_t>(from_row) * columns + c] + 1;
        if (nearest < distance[at]) distance[at] = nearest;
      }
    };
    for (int row = 0; row < rows; ++row)
      for (int c = first; c < end; ++c) {
        const std::size_t at = static_cast<std::size_t>(row) * columns + c;
        distance[at] = marked[at] != 0 ? 0 : static_cast<std::uint32_t>(kFar);
      }
    for (int row = 1; row < rows; ++row) step(row, row - 1);
    for (int row = rows - 2; row >= 0; --row) step(row, row + 1);
  });
}

/// The lower envelope of the parabolas (x - site)^2 + g(site)^2 along a row.
class Envelope {
 public:
  void build(const std::vector<std::int64_t>& g) {
    site_.clear();
    from_.clear();
    const std::int64_t size = static_cast<std::int64_t>(g.size());
    const auto value = [&](std::int64_t x, std::int64_t s) { return (x - s) * (x - s) + g[s] * g[s]; };
    for (std::int64_t u = 0; u < size; ++u) {
      if (g[u] >= kFar) continue;
      while (!site_.empty() && value(from_.back(), site_.back()) > value(from_.back(), u)) {
        site_.pop_back();
        from_.pop_back();
      }
      if (site_.empty()) {
        site_.push_back(u);
        from_.push_back(0);
        continue;
      }
      // The last x at which the older parabola is not above the newer one. Both terms are not negative.
      const std::int64_t s = site_.back();
      const std::int64_t rise = u * u - s * s + g[u] * g[u] - g[s] * g[s];
      if (rise < 0) continue;
      const std::int64_t last = rise / (2 * (u - s));
      if (last + 1 >= size) continue;
      site_.push_back(u);
      from_.push_back(last + 1);
    }
  }
  bool empty() const { return site_.empty(); }

  /// Calls use(x, square) from the last x to the first.
  template <class Use>
  void from_the_end(const std::vector<std::int64_t>& g, const Use& use) const {
    std::size_t at = site_.size() - 1;
    for (std::int64_t x = static_cast<std::int64_t>(g.size()) - 1; x >= 0; --x) {
      while (from_[at] > x) --at;
      const std::int64_t s = site_[at];
      use(x, (x - s) * (x - s) + g[s] * g[s]);
    }
  }

 private:
  std::vector<std::int64_t> site_, from_;
};

}  // namespace

std::vector<std::uint32_t> squared_distance(const std::vector<std::uint8_t>& marked, int columns, int rows,
                                            bool wraps, int threads) {
  assert(columns < 32768 && rows < 32768);
  std::vector<std::uint32_t> distance(static_cast<std::size_t>(columns) * rows);
  down_columns(marked, columns, rows, threads, distance);
  parallel_for(static_cast<std::size_t>(rows), threads, [&](std::size_t row, int) {
    std::uint32_t* line = distance.data() + row * columns;
    // A row that wraps stands between two copies of itself.
    const int copies = wraps ? 3 : 1;
    std::vector<std::int64_t> g;
    g.reserve(static_cast<std::size_t>(columns) * copies);
    for (int copy = 0; copy < copies; ++copy) g.insert(g.end(), line, line + columns);
    Envelope envelope;
    envelope.build(g);
    if (envelope.empty()) {
      for (int c = 0; c < columns; ++c) line[c] = kNoMark;
      return;
    }
    const std::int64_t first = wraps ? columns : 0;
    envelope.from_the_end(g, [&](std::int64_t x, std::int64_t square) {
      if (x >= first && x < first + columns) line[x - first] = static_cast<std::uint32_t>(square);
    });
  });
  return distance;
}

}  // namespace vegard::sim
