// A hierarchy of boxes to find what a ray may meet of many small parts: segments of strands, or the walls of
// a curtain.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/number/vec3.h"

namespace vegard::sim {

/// The box of a segment, and the data by which it is enlarged if the distance between rays is large (0 and 0:
/// never).
struct SegmentBox {
  Vec3<double> low, high;
  double min_radius;    ///< of the segment
  double max_distance;  ///< largest distance of the segment to the observer
};

/// The tree is built once and deterministically; boxes are split at the median along their longest side.
class SegmentTree {
 public:
  SegmentTree() = default;
  explicit SegmentTree(const std::vector<SegmentBox>& boxes);

  /// Calls use(index of a segment) for all segments whose boxes the ray passes between s = first and last,
  /// and possibly for others, in an order that depends on the ray alone. Segments have at least the radius
  /// `blur` times their distance.
  template <class Use>
  void visit(const Vec3<double>& nearest, const Vec3<double>& direction, double first, double last,
             double blur, const Use& use) const;

 private:
  struct Node {
    float low[3], high[3];
    float min_radius, max_distance;
    std::int32_t begin, count;  ///< segments of a leaf; count 0: children are the next node and `begin`
  };

  std::int32_t build(const std::vector<SegmentBox>& boxes, std::size_t begin, std::size_t end);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

template <class Use>
void SegmentTree::visit(const Vec3<double>& nearest, const Vec3<double>& direction, double first, double last,
                        double blur, const Use& use) const {
  if (nodes_.empty()) return;
  Vec3<double> inverse;
  for (int i = 0; i < 3; ++i) {
    // Avoids 0 times infinity for rays parallel to a side of a box.
    const bool tiny = direction[i] < 1e-200 && direction[i] > -1e-200;
    inverse[i] = 1.0 / (tiny ? 1e-200 : direction[i]);
  }
  constexpr int kDeepest = 64;
  std::int32_t stack[kDeepest];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::int32_t at = stack[--depth];
    const Node& node = nodes_[at];
    const double wide = blur * node.max_distance - node.min_radius, pad = wide > 0.0 ? wide : 0.0;
    double low = first, high = last;
    for (int i = 0; i < 3; ++i) {
      const double a = (node.low[i] - pad - nearest[i]) * inverse[i],
                   b = (node.high[i] + pad - nearest[i]) * inverse[i];
      const double in = a < b ? a : b, out = a < b ? b : a;
      low = in > low ? in : low;
      high = out < high ? out : high;
    }
    if (low > high) continue;
    if (node.count > 0) {
      for (std::int32_t i = 0; i < node.count; ++i) use(order_[node.begin + i]);
    } else {
      stack[depth++] = node.begin;
      stack[depth++] = at + 1;
    }
  }
}

}  // namespace vegard::sim
