#include "sim/light/segment_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace vegard::sim {
namespace {

constexpr std::size_t kLeaf = 4;

float float_below(double x) {
  return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::max());
}
float float_above(double x) {
  return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::max());
}

}  // namespace

SegmentTree::SegmentTree(const std::vector<SegmentBox>& boxes) : order_(boxes.size()) {
  if (boxes.empty()) return;
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(boxes.size());
  build(boxes, 0, boxes.size());
}

std::int32_t SegmentTree::build(const std::vector<SegmentBox>& boxes, std::size_t begin, std::size_t end) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3<double> low, high, first, last;
  low.fill(kInfinity);
  first.fill(kInfinity);
  high.fill(-kInfinity);
  last.fill(-kInfinity);
  double min_radius = kInfinity, max_distance = 0.0;
  for (std::size_t k = begin; k < end; ++k) {
    const SegmentBox& box = boxes[order_[k]];
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], box.low[i]);
      high[i] = std::max(high[i], box.high[i]);
      first[i] = std::min(first[i], box.low[i] + box.high[i]);
      last[i] = std::max(last[i], box.low[i] + box.high[i]);
    }
    min_radius = std::min(min_radius, box.min_radius);
    max_distance = std::max(max_distance, box.max_distance);
  }
  const std::int32_t at = static_cast<std::int32_t>(nodes_.size());
  nodes_.push_back({});
  Node node;
  for (int i = 0; i < 3; ++i) {
    node.low[i] = float_below(low[i]);
    node.high[i] = float_above(high[i]);
  }
  node.min_radius = float_below(min_radius);
  node.max_distance = float_above(max_distance);
  node.begin = static_cast<std::int32_t>(begin);
  node.count = static_cast<std::int32_t>(end - begin);
  if (end - begin > kLeaf) {
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (last[i] - first[i] > last[axis] - first[axis]) axis = i;
    const std::size_t middle = begin + (end - begin) / 2;
    // A total order, so that the halves are the same with every library.
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double middle_a = boxes[a].low[axis] + boxes[a].high[axis],
                                    middle_b = boxes[b].low[axis] + boxes[b].high[axis];
                       return middle_a != middle_b ? middle_a < middle_b : a < b;
                     });
    std::sort(order_.begin() + begin, order_.begin() + middle);
    std::sort(order_.begin() + middle, order_.begin() + end);
    node.count = 0;
    build(boxes, begin, middle);
    node.begin = build(boxes, middle, end);
  }
  nodes_[at] = node;
  return at;
}

}  // namespace vegard::sim
