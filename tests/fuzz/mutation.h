// Spoils inputs, the same way for the same number.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vegard::tests {

struct Mutation {
  std::uint64_t seed = 1;
  std::size_t max_bytes = 1 << 16;
  std::vector<std::string> dictionary;
};

/// The input that number `index` makes of `corpus` (not empty): one of it, spoilt in one to eight places by
/// flipped bits, changed bytes, integers at their edges in either byte order, pieces cut out, doubled, moved
/// or cut off, words of the dictionary, digits, and pieces of another input. A pure function of its
/// arguments.
std::string mutated(const Mutation& mutation, const std::vector<std::string>& corpus, std::uint32_t index);

}  // namespace vegard::tests
