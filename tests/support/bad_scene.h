// Scene files that are refused, and what is said about them.
#pragma once

#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/expect_error.h"

namespace vegard::sim {

inline ErrorDetails error_of(const std::string& text) {
  try {
    parse_scene(text, "aurora.toml");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::scene) << text;
    EXPECT_EQ(error.details().file, "aurora.toml") << text;
    EXPECT_GT(error.details().line, 0) << text;
    return error.details();
  }
  ADD_FAILURE() << "no error was thrown for:\n" << text;
  return {};
}

struct Bad {
  const char* what;
  const char* text;
  int line;
  const char* key;
  const char* facts;  ///< of problem, expected and hint together, with " | " between them
};

// GoogleTest would print the addresses of the texts, and so name the test differently on each run.
inline void PrintTo(const Bad& bad, std::ostream* stream) { *stream << bad.what; }

inline void expect_refused(const Bad& bad) {
  const ErrorDetails details = error_of(bad.text);
  const std::string words = details.problem + " | " + details.expected + " | " + details.hint;
  EXPECT_EQ(details.line, bad.line) << words;
  EXPECT_EQ(details.key, bad.key) << words;
  EXPECT_TRUE(tests::has_facts(words, bad.facts));
}

}  // namespace vegard::sim
