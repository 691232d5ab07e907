#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <array>

#include "sim/base/number/random.h"

namespace vegard::tests {
namespace {

/// Numbers one after the other for one input.
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint32_t index) : key_(sim::random_key(seed)), index_(index) {}

  std::uint32_t word() {
    if (used_ == words_.size()) {
      constexpr std::uint32_t kFuzz = 0x66757a7a;  // no stream of the simulator
      words_ = sim::philox4x32({index_, block_++, 0, kFuzz}, key_);
      used_ = 0;
    }
    return words_[used_++];
  }
  /// 0 to count - 1; 0 if there are none.
  std::size_t below(std::size_t count) { return count == 0 ? 0 : word() % count; }
  /// A length up to `most`, short ones more often.
  std::size_t length(std::size_t most) {
    const std::size_t scale = std::size_t{1} << below(13);
    return std::min(most, 1 + below(scale));
  }

 private:
  std::array<std::uint32_t, 2> key_;
  std::uint32_t index_, block_ = 0;
  sim::Words words_{};
  std::size_t used_ = words_.size();
};

void put_over(std::string& input, std::size_t at, const std::string& piece) {
  input.replace(at, std::min(piece.size(), input.size() - at), piece);
}

/// Where most lies are told: in the first bytes.
std::size_t place(Dice& dice, const std::string& input) {
  return dice.below(2) == 0 ? dice.below(std::min<std::size_t>(input.size(), 256)) : dice.below(input.size());
}

std::string edge(Dice& dice) {
  constexpr std::uint64_t kEdges[] = {0,          1,          2,          0x7f,        0x80,       0xff,
                                      0x100,      0x7fff,     0x8000,     0xffff,      0x10000,    40000,
                                      0x7fffffff, 0x80000000, 0xffffffff, 0x100000000, ~0ull >> 1, ~0ull};
  const std::uint64_t value = kEdges[dice.below(std::size(kEdges))] - dice.below(2);
  const std::size_t size = std::size_t{1} << dice.below(4);
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
  if (dice.below(2) == 0) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// Puts another number in the place of one written in digits.
void change_digits(Dice& dice, std::string& input) {
  constexpr const char* kNumbers[] = {"0",   "-1",  "1e308", "1e-308", "4294967296", "9223372036854775807",
                                      "nan", "inf", "-inf",  "0.5",    "-0.0",       "40000"};
  std::size_t begin = input.find_first_of("0123456789", place(dice, input));
  if (begin == std::string::npos) return;
  std::size_t end = input.find_first_not_of("0123456789.", begin);
  if (end == std::string::npos) end = input.size();
  input.replace(begin, end - begin, kNumbers[dice.below(std::size(kNumbers))]);
}

void change_once(Dice& dice, const Mutation& mutation, const std::vector<std::string>& corpus,
                 std::string& input) {
  if (input.empty()) input = corpus[dice.below(corpus.size())];
  if (input.empty()) return;
  const std::size_t at = place(dice, input), left = input.size() - at;
  switch (dice.below(12)) {
    case 0:
      input[at] = static_cast<char>(input[at] ^ 1 << dice.below(8));
      break;
    case 1:
      input[at] = static_cast<char>(dice.word());
      break;
    case 2:
    case 3:
      put_over(input, at, edge(dice));
      break;
    case 4:
      input.erase(at, dice.length(left));
      break;
    case 5:
      input.insert(at, input.substr(at, dice.length(left)));
      break;
    case 6:
      put_over(input, dice.below(input.size()), input.substr(at, dice.length(left)));
      break;
    case 7:
      if (dice.below(4) == 0) input.resize(at);
      break;
    case 8:
    case 9: {
      if (mutation.dictionary.empty()) break;
      const std::string& piece = mutation.dictionary[dice.below(mutation.dictionary.size())];
      if (dice.below(2) == 0)
        put_over(input, at, piece);
      else
        input.insert(at, piece);
      break;
    }
    case 10:
      change_digits(dice, input);
      break;
    default: {
      const std::string& other = corpus[dice.below(corpus.size())];
      const std::size_t from = dice.below(other.size());
      input = input.substr(0, at) + other.substr(from);
      break;
    }
  }
}

}  // namespace

std::string mutated(const Mutation& mutation, const std::vector<std::string>& corpus, std::uint32_t index) {
  Dice dice(mutation.seed, index);
  std::string input = corpus[dice.below(corpus.size())];
  const std::size_t changes = 1 + dice.below(8);
  for (std::size_t i = 0; i < changes; ++i) change_once(dice, mutation, corpus, input);
  if (input.size() > mutation.max_bytes) input.resize(mutation.max_bytes);
  return input;
}

}  // namespace vegard::tests
