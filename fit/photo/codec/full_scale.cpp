#include "fit/photo/codec/full_scale.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace vegard::fit {
namespace full_scale {

/// What the numbers of a picture have in common, counted in steps.
struct Numbers {
  std::uint32_t largest = 0, any_bit = 0;
  std::size_t at_largest = 0, before_it = 0;
  bool are_whole = true;
};

template <class Visit>
void each_usable(const PictureCodes& codes, const Visit& visit) {
  for (std::size_t i = 0; i < codes.size(); ++i)
    if (codes.usable.empty() || codes.usable[i] != 0) visit(i, codes.value(i) / codes.step);
}

Numbers numbers_of(const PictureCodes& codes) {
  Numbers all;
  each_usable(codes, [&](std::size_t, double number) {
    if (!(number >= 0.0 && number <= 4294967295.0 && number == std::floor(number))) {
      all.are_whole = all.are_whole && number < 0.0 && number == std::floor(number);
      return;
    }
    const auto whole = static_cast<std::uint32_t>(number);
    all.any_bit |= whole;
    all.largest = std::max(all.largest, whole);
  });
  return all;
}

void count_at_top(const PictureCodes& codes, std::uint32_t next_below, Numbers& all) {
  each_usable(codes, [&](std::size_t, double number) {
    all.at_largest += number == all.largest ? 1 : 0;
    all.before_it += number == next_below ? 1 : 0;
  });
}

int zeros_at_end(std::uint32_t word) {
  int zeros = 0;
  while (word != 0 && (word & 1u) == 0) word >>= 1, ++zeros;
  return zeros;
}

}  // namespace full_scale

void mark_full_scale(int bits, PictureCodes& codes) {
  using namespace full_scale;
  constexpr int kMostBits = 32, kFewestUndeclared = 10;
  if (codes.floating || codes.bits <= 8 || codes.bits > kMostBits || !(codes.step > 0.0)) return;
  Numbers all = numbers_of(codes);
  if (!all.are_whole || all.largest == 0) return;
  std::uint32_t full = 0;
  if (bits > 8 && bits < codes.bits) {
    const std::uint32_t low = (std::uint32_t{1} << bits) - 1, high = low << (codes.bits - bits);
    const bool is_shifted = (all.any_bit & ((std::uint32_t{1} << (codes.bits - bits)) - 1)) == 0;
    full = all.largest <= low ? low : is_shifted ? high : 0;
    if (full == low && codes.linear) codes.white = std::min(codes.white, low * codes.step);
  }
  if (full == 0) {
    const int shift = zeros_at_end(all.any_bit);
    const std::uint32_t top = all.largest >> shift;
    const bool is_plateau = top + 1 >= (std::uint32_t{1} << kFewestUndeclared) && (top & (top + 1)) == 0 &&
                            all.largest * codes.step < codes.white;
    if (!is_plateau) return;
    count_at_top(codes, all.largest - (std::uint32_t{1} << shift), all);
    if (all.at_largest < 2 || all.at_largest <= all.before_it) return;
    full = all.largest;
  }
  if (all.largest < full) return;
  if (codes.usable.empty()) codes.usable.assign(codes.size(), 1);
  for (std::size_t i = 0; i < codes.size(); ++i)
    if (codes.value(i) / codes.step >= full) codes.usable[i] = 0;
}

}  // namespace vegard::fit
