// Order statistics of values in any order. Each is one of the values: nothing is interpolated. The values are
// left in another order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace vegard::sim {

/// Returns the value at a place from 0 on, as if the values were sorted.
template <class T>
T nth_value(std::vector<T>& values, std::size_t place) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Returns the quantile at a share from 0 to 1, NaN if there are no values.
template <class T>
T quantile(std::vector<T>& values, double share) {
  if (values.empty()) return std::numeric_limits<T>::quiet_NaN();
  return nth_value(values, static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

/// Returns the middle value, of an even number of values the upper one of two, 0 if there are no values.
template <class T>
T median(std::vector<T>& values) {
  return values.empty() ? T{} : nth_value(values, values.size() / 2);
}

}  // namespace vegard::sim
