// The numbers of a picture as its decoder hands them over, with what has decoded it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vegard::sim {

struct CodedPicture {
  int width = 0, height = 0;         ///< upright
  std::vector<std::uint16_t> codes;  ///< R, G, B of each pixel, row by row from the top
  int bits = 8;                      ///< white is 2^bits - 1
  std::string library;               ///< "LibRaw 0.20.2-Release": another version may give other numbers
};

}  // namespace vegard::sim
