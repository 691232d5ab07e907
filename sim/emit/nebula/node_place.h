// Where a density node stands: stretched, turned and moved.
#pragma once

#include <type_traits>

#include "sim/base/earth.h"
#include "sim/light/sample.h"

namespace vegard::sim {

/// The turns about right, up and near, one after the other: from the outside to the inside.
template <class T>
void turn_inside(const T angle_deg[3], T turn[9]) {
  T sin[3], cos[3];
  for (int axis = 0; axis < 3; ++axis) {
    sin[axis] = sine(angle_deg[axis] * kRadiansPerDegree);
    cos[axis] = cosine(angle_deg[axis] * kRadiansPerDegree);
  }
  // The rows of the inverse are the columns of Z Y X.
  turn[0] = cos[2] * cos[1];
  turn[1] = sin[2] * cos[1];
  turn[2] = T(0.0) - sin[1];
  turn[3] = cos[2] * sin[1] * sin[0] - sin[2] * cos[0];
  turn[4] = sin[2] * sin[1] * sin[0] + cos[2] * cos[0];
  turn[5] = cos[1] * sin[0];
  turn[6] = cos[2] * sin[1] * cos[0] + sin[2] * sin[0];
  turn[7] = sin[2] * sin[1] * cos[0] - cos[2] * sin[0];
  turn[8] = cos[1] * cos[0];
}

/// A point as what stands inside sees it. N is double or T.
template <class N, class Place>
void to_inside(const Place& node, const N outer[3], N inner[3]) {
  const auto as = [](const auto& number) {
    if constexpr (std::is_same_v<N, double>)
      return value_of(number);
    else
      return number;
  };
  N shifted[3];
  for (int axis = 0; axis < 3; ++axis) shifted[axis] = outer[axis] - as(node.center[axis]);
  for (int row = 0; row < 3; ++row)
    inner[row] = (as(node.turn[3 * row]) * shifted[0] + as(node.turn[3 * row + 1]) * shifted[1] +
                  as(node.turn[3 * row + 2]) * shifted[2]) /
                 as(node.stretch[row]);
}

}  // namespace vegard::sim
