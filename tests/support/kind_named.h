// Kinds by their words, for tests that run through several and are called by them.
#pragma once

#include <stdexcept>
#include <string>

#include "sim/scene/table/parameter_table.h"

namespace vegard::tests {

/// The enumerator that scene files call `word`. Throws std::invalid_argument if it has none of that word.
template <class Kind>
Kind kind_named(const std::string& word) {
  constexpr int kMax = 64;
  for (int number = 0; number < kMax; ++number)
    if (const Kind kind = static_cast<Kind>(number); sim::word_of(kind) == word) return kind;
  throw std::invalid_argument("no kind is called " + word);
}

}  // namespace vegard::tests
