// The sim::Error that a piece of code throws: its kind, and the facts in its text.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/error.h"

namespace vegard::tests {

/// Whether a text has all these facts, which " | " divides: numbers, keys and names. Its sentences are not
/// asked for, so that they can be bettered.
inline testing::AssertionResult has_facts(const std::string& text, const std::string& facts) {
  const std::string divider = " | ";
  for (std::size_t begin = 0; begin <= facts.size();) {
    const std::size_t end = std::min(facts.find(divider, begin), facts.size());
    const std::string fact = facts.substr(begin, end - begin);
    if (text.find(fact) == std::string::npos) {
      return testing::AssertionFailure() << "no '" << fact << "' in: " << text;
    }
    begin = end + divider.size();
  }
  return testing::AssertionSuccess();
}

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

/// Fails the test unless `code` throws a sim::Error of this kind with these facts in its text.
template <typename Code>
void expect_words(sim::ErrorKind kind, const std::vector<std::string>& facts, const Code& code) {
  const std::string text = expect_error(kind, code);
  for (const std::string& fact : facts) EXPECT_TRUE(has_facts(text, fact));
}

}  // namespace vegard::tests
