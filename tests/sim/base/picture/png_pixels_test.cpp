#include "sim/base/picture/png_pixels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/base/picture/image_io.h"

namespace vegard::sim::png_pixels_test {
namespace {

constexpr int kWidth = 37, kHeight = 23;

/// A ramp of which every value is different, in 0 to 1.
Image ramp(const std::vector<std::string>& names) {
  Image image(kWidth, kHeight, names);
  for (std::size_t i = 0; i < image.data.size(); ++i)
    image.data[i] = static_cast<float>(i) / static_cast<float>(image.data.size() - 1);
  return image;
}

std::string png_of(const Image& image, int bits) {
  return encode_display(ImageFormat::png, image, bits, 0, {}, "a.png");
}

template <class Code>
void expect_ramp(const std::vector<std::string>& names) {
  constexpr int kBits = 8 * sizeof(Code);
  const Image image = ramp(names);
  std::vector<Code> codes(std::size_t{3} * kWidth * kHeight);
  ASSERT_TRUE(read_png_pixels(png_of(image, kBits), kWidth, kHeight, kBits, codes.data())) << kBits;
  const std::size_t channels = names.size();
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const std::size_t channel = channels == 1 ? 0 : 2 - i % 3;  // blue comes first
    const double wanted = image.data[i / 3 * channels + channel] * ((1 << kBits) - 1);
    ASSERT_LE(std::abs(codes[i] - wanted), 0.5 + 1e-3) << kBits << " bits, " << channels << ", " << i;
  }
}

TEST(PngPixels, AreThoseThatWereWritten) {
  for (const auto& names : {std::vector<std::string>{"Y"}, std::vector<std::string>{"R", "G", "B"}}) {
    expect_ramp<std::uint8_t>(names);
    expect_ramp<std::uint16_t>(names);
  }
}

TEST(PngPixels, OfAnotherSizeOrOfDamageAreNotRead) {
  const std::string bytes = png_of(ramp({"R", "G", "B"}), 8);
  std::vector<std::uint16_t> room(std::size_t{3} * (kWidth + 1) * (kHeight + 1));
  EXPECT_TRUE(read_png_pixels(bytes, kWidth, kHeight, 8, room.data()));
  EXPECT_FALSE(read_png_pixels(bytes, kWidth + 1, kHeight, 8, room.data()));
  EXPECT_FALSE(read_png_pixels(bytes, kWidth, kHeight + 1, 8, room.data()));
  EXPECT_FALSE(read_png_pixels(bytes, kWidth, kHeight, 16, room.data()));
  EXPECT_FALSE(read_png_pixels(bytes, kWidth, kHeight, 4, room.data()));
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_FALSE(read_png_pixels(bytes.substr(0, length), kWidth, kHeight, 8, room.data())) << length;
  std::string changed = bytes;
  changed[bytes.find("IDAT") + 40] ^= 1;  // which a checksum tells
  EXPECT_FALSE(read_png_pixels(changed, kWidth, kHeight, 8, room.data()));
}

}  // namespace
}  // namespace vegard::sim::png_pixels_test
