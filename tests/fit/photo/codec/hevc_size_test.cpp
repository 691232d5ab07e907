
#include <gtest/gtest.h>

#include "fit/photo/codec/picture_format.h"
#include "tests/support/image_bytes.h"
#include "tests/support/source_folder.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::hevc_size_test {
namespace {

/// The body of the box hvcC of a picture of 64 x 32 pixels, which its encoder stored as 64 x 64.
std::string configuration() {
  const std::string bytes = tests::bytes_of(tests::source_folder() + "/tests/data/quarters.heic");
  const std::size_t type = bytes.find("hvcC");
  std::size_t size = 0;
  for (std::size_t i = 4; i > 0; --i) size = size << 8 | static_cast<unsigned char>(bytes[type - i]);
  return bytes.substr(type + 4, size - 8);
}

/// A configuration with this parameter set alone, as bits behind what nobody asks for.
std::string with_bits(const std::string& bits) {
  const std::string unit = std::string(2, '\x42') + std::string(1, '\0') + std::string(12, '\x11');
  std::string all = bits;
  all.resize((bits.size() + 7) / 8 * 8, '0');
  std::string set = unit;
  for (std::size_t i = 0; i < all.size(); i += 8)
    set += static_cast<char>(std::stoi(all.substr(i, 8), nullptr, 2));
  return std::string(22, '\0') + "\x01\x21" + tests::big_endian(1, 2) + tests::big_endian(set.size(), 2) +
         set;
}

TEST(HevcSize, OfAStream) {
  const auto size = hevc_size(configuration());
  ASSERT_TRUE(size.has_value());
  EXPECT_EQ(size->first, 64);
  EXPECT_EQ(size->second, 64);
}

// ue(0) ue(1): 4:2:0; ue(7), ue(15): 7 x 15; a window of 1, 0, 2, 3 pairs of pixels.
TEST(HevcSize, OfBitsByHand) {
  const std::string numbers =
      "1010"
      "0001000"
      "000010000";
  EXPECT_EQ(hevc_size(with_bits(numbers + "0")), (std::pair<long long, long long>(7, 15)));
  EXPECT_EQ(hevc_size(with_bits(numbers + "1"
                                          "010"
                                          "1"
                                          "011"
                                          "00100")),
            (std::pair<long long, long long>(5, 5)));
  // Nothing is left of 7 pixels; a number of more than 32 bits.
  EXPECT_FALSE(hevc_size(with_bits(numbers + "1"
                                             "00101"
                                             "1"
                                             "1"
                                             "1"))
                   .has_value());
  EXPECT_FALSE(hevc_size(with_bits(std::string(70, '0'))).has_value());
}

TEST(HevcSize, WhatIsCutSaysNothing) {
  const std::string whole = configuration();
  std::size_t known = 0;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const auto found = hevc_size(whole.substr(0, size));
    if (!found) continue;
    ++known;
    EXPECT_EQ(found->first, 64);
  }
  EXPECT_GT(known, 0u);
  EXPECT_LT(known, whole.size() / 2);
}

}  // namespace
}  // namespace vegard::fit::hevc_size_test
