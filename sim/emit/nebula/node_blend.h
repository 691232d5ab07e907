// Union and intersection of signed distances, sharp or rounded.
//
// The rounded least of a and b is min(a, b) - b_l/4 h², h = max(1 - |a - b| / b_l, 0), with the blend's
// length b_l: a parabola where the two are nearer to each other than that, the sharp one elsewhere;
// continuous with its slope. It is never more than the sharp one, and never less than that minus b_l/4.
#pragma once

#include "sim/emit/nebula/node_shapes.h"

namespace vegard::sim {

template <class T>
T blended_least(const T& a, const T& b, const T& blend) {
  const T least = smaller(a, b);
  if (!(value_of(blend) > 0.0)) return least;
  const T near = larger(T(1.0) - magnitude(a - b) / blend, T(0.0));
  return value_of(near) > 0.0 ? least - blend * near * near * 0.25 : least;
}

template <class T>
T blended_most(const T& a, const T& b, const T& blend) {
  return T(0.0) - blended_least(T(0.0) - a, T(0.0) - b, blend);
}

}  // namespace vegard::sim
