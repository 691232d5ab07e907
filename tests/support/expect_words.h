// The kind of the sim::Error that a piece of code throws, and words of its text.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/expect_error.h"

namespace vegard::tests {

/// Fails the test unless `code` throws a sim::Error of this kind with these words in its text.
template <typename Code>
void expect_words(sim::ErrorKind kind, const std::vector<std::string>& words, const Code& code) {
  const std::string text = expect_error(kind, code);
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << text;
}

}  // namespace vegard::tests
