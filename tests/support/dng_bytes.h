// A camera raw file made by hand: an uncompressed DNG 1.1 of 16 bits behind an RGGB mosaic.
#pragma once

#include <string>
#include <vector>

#include "tests/support/image_bytes.h"

namespace vegard::tests {

struct Dng {
  int width = 32, height = 24;
  int orientation = 1;
  int black = 0, white = 65535;
  int claimed_width = 0, claimed_height = 0;  ///< in the header, if not the true ones
};

/// One site per number, row by row; red at (0, 0), green beside and below it, blue at (1, 1).
inline std::string dng(const Dng& d, const std::vector<int>& sites) {
  std::string pixels;
  for (const int site : sites) pixels += little_endian(site, 2);
  struct Entry {
    int tag, type, count;
    std::string data;
  };
  const auto bytes = [](std::initializer_list<int> values) {
    std::string s;
    for (const int value : values) s += static_cast<char>(value);
    return s;
  };
  const auto word = [](int tag, std::uint64_t value) { return Entry{tag, 4, 1, little_endian(value, 4)}; };
  const auto half = [](int tag, int value) { return Entry{tag, 3, 1, little_endian(value, 2)}; };
  const auto text = [](int tag, const std::string& words) {
    return Entry{tag, 2, static_cast<int>(words.size()) + 1, words + '\0'};
  };
  std::string identity;
  for (int i = 0; i < 9; ++i) identity += little_endian(i % 4 == 0 ? 1 : 0, 4) + little_endian(1, 4);
  const std::string ones = little_endian(1, 4) + little_endian(1, 4) + little_endian(1, 4) +
                           little_endian(1, 4) + little_endian(1, 4) + little_endian(1, 4);
  std::vector<Entry> entries = {word(254, 0),
                                word(256, d.claimed_width > 0 ? d.claimed_width : d.width),
                                word(257, d.claimed_height > 0 ? d.claimed_height : d.height),
                                half(258, 16),
                                half(259, 1),
                                half(262, 32803),
                                text(271, "vegard"),
                                text(272, "made by hand"),
                                word(273, 0),
                                half(274, d.orientation),
                                half(277, 1),
                                word(278, d.height),
                                word(279, pixels.size()),
                                half(284, 1),
                                {33421, 3, 2, little_endian(2, 2) + little_endian(2, 2)},
                                {33422, 1, 4, bytes({0, 1, 1, 2})},
                                {50706, 1, 4, bytes({1, 1, 0, 0})},
                                {50707, 1, 4, bytes({1, 1, 0, 0})},
                                text(50708, "vegard made by hand"),
                                half(50714, d.black),
                                half(50717, d.white),
                                {50721, 10, 9, identity},
                                {50728, 5, 3, ones},
                                half(50778, 21)};
  const std::size_t lists = 8 + 2 + 12 * entries.size() + 4;
  std::size_t far = 0;
  for (const Entry& entry : entries)
    if (entry.data.size() > 4) far += (entry.data.size() + 1) / 2 * 2;
  std::string head = "II" + little_endian(42, 2) + little_endian(8, 4) + little_endian(entries.size(), 2);
  std::string rest;
  for (Entry& entry : entries) {
    if (entry.tag == 273) entry.data = little_endian(lists + far, 4);
    head += little_endian(entry.tag, 2) + little_endian(entry.type, 2) + little_endian(entry.count, 4);
    if (entry.data.size() > 4) {
      head += little_endian(lists + rest.size(), 4);
      rest += entry.data + (entry.data.size() % 2 ? std::string(1, '\0') : "");
    } else {
      entry.data.resize(4, '\0');
      head += entry.data;
    }
  }
  return head + little_endian(0, 4) + rest + pixels;
}

}  // namespace vegard::tests
