// The header of a PGM or PPM file (netpbm's pgm(5), ppm(5)).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vegard::fit {

struct PnmHeader {
  long long width = 0, height = 0;
  int channels = 1;       ///< 1 of a PGM, 3 of a PPM
  int largest = 255;      ///< the number of white, 1 to 65535
  bool in_words = false;  ///< decimal numbers (P2, P3), else bytes, two of them above 255
  std::size_t data = 0;   ///< where the pixels begin
};

/// Throws sim::Error(unreadable_input) for a header that ends early or makes no sense.
PnmHeader pnm_header(std::string_view bytes, const std::string& file);

/// The next decimal number at `at`, comments passed over, -1 if there is none (numbers end at 2^40). `at` is
/// then behind it.
long long next_pnm_number(std::string_view bytes, std::size_t& at);

}  // namespace vegard::fit
