// Whether two arrays of floats are the same to the last bit.
#pragma once

#include <cstring>

#include <gtest/gtest.h>

namespace vegard::tests {

template <class Floats>
::testing::AssertionResult same_bytes(const Floats& a, const Floats& b) {
  if (a.size() != b.size()) return ::testing::AssertionFailure() << a.size() << " numbers and " << b.size();
  std::size_t differ = 0, first = 0;
  for (std::size_t i = a.size(); i-- > 0;)
    if (std::memcmp(&a[i], &b[i], sizeof(float)) != 0) ++differ, first = i;
  if (differ == 0) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << differ << " of " << a.size() << " differ, the first at " << first
                                       << ": " << a[first] << " and " << b[first];
}

}  // namespace vegard::tests
