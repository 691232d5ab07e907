// The kind and text of the sim::Error that a piece of code throws.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "sim/base/error.h"

namespace vegard::tests {

/// Fails the test unless `code` throws a sim::Error of this kind. Returns its text.
template <typename Code>
std::string expect_error(sim::ErrorKind kind, Code&& code) {
  try {
    std::forward<Code>(code)();
  } catch (const sim::Error& error) {
    EXPECT_EQ(static_cast<int>(error.kind()), static_cast<int>(kind)) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

}  // namespace vegard::tests
