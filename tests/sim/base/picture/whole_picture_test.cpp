#include "sim/base/picture/whole_picture.h"

#include <gtest/gtest.h>

#include <string>

#include "sim/base/picture/image_io.h"

namespace vegard::sim::whole_picture_test {
namespace {

std::string encoded(ImageFormat format) {
  Image image(40, 30, {"R", "G", "B"});
  for (std::size_t i = 0; i < image.data.size(); ++i)
    image.data[i] = static_cast<float>(i * 7 % 101) / 101.0f;
  return encode_display(format, image, 8, 90, {{"scene", "seed = 1"}});
}

TEST(WholePicture, IsWholeOnlyToItsLastByte) {
  const std::string png = encoded(ImageFormat::png), jpeg = encoded(ImageFormat::jpeg);
  EXPECT_TRUE(png_is_whole(png));
  EXPECT_TRUE(jpeg_is_whole(jpeg));
  for (std::size_t length = 0; length < png.size(); ++length)
    ASSERT_FALSE(png_is_whole(png.substr(0, length)));
  for (std::size_t length = 0; length < jpeg.size(); ++length)
    ASSERT_FALSE(jpeg_is_whole(jpeg.substr(0, length)));
  EXPECT_FALSE(png_is_whole(jpeg));
  EXPECT_FALSE(jpeg_is_whole(png));
}

TEST(WholePicture, APngWithAChangedByteIsNot) {
  std::string png = encoded(ImageFormat::png);
  for (std::size_t at = 0; at < png.size(); at += 13) {
    png[at] ^= 0x10;
    EXPECT_FALSE(png_is_whole(png)) << at;
    png[at] ^= 0x10;
  }
}

TEST(WholePicture, TheEndOfASmallPictureInsideIsNotTheEnd) {
  const std::string inner = encoded(ImageFormat::jpeg);
  const std::size_t length = inner.size() + 2;
  ASSERT_LT(length, 65536u);
  std::string outer("\xFF\xD8\xFF\xE1", 4);
  outer += static_cast<char>(length >> 8);
  outer += static_cast<char>(length & 0xFF);
  outer += inner + inner.substr(2);
  EXPECT_TRUE(jpeg_is_whole(outer));
  EXPECT_TRUE(jpeg_is_whole(outer + "and some words of the camera's"));
  EXPECT_FALSE(jpeg_is_whole(outer.substr(0, outer.size() - 300)));
}

}  // namespace
}  // namespace vegard::sim::whole_picture_test
