#include "sim/base/picture/whole_picture.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/picture/image_io.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::whole_picture_test {
namespace {

using tests::TemporaryFolder;

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

TEST(WholePicture, AnExrsHeaderPromisesNoMoreThanTheFileHolds) {
  const Image image(40, 30, {"R", "G", "B"});
  const std::string exr = encode_exr({&image}, {{"scene", "seed = 1"}}, "it.exr");
  const ExrSize size = check_exr_header(exr, exr.size(), "it.exr");
  EXPECT_EQ(size.width, 40);
  EXPECT_EQ(size.height, 30);
  const auto refused = [](const std::string& beginning, std::size_t file_bytes) {
    return tests::expect_error(ErrorKind::unreadable_input,
                               [&] { check_exr_header(beginning, file_bytes, "it.exr"); });
  };
  // Of the strings in it one of almost two gigabytes: OpenEXR 3.1 would make room for it.
  std::string lies = exr;
  const std::size_t string = lies.find(std::string_view("string\0", 7));
  ASSERT_NE(string, std::string::npos);
  lies.replace(string + 7, 4, std::string_view("\0\x13\0\x6c", 4));
  EXPECT_NE(refused(lies, lies.size()).find("EXR header"), std::string::npos);
  const TemporaryFolder folder;
  tests::put(folder / "it.exr", lies);
  for (const auto& read : std::vector<std::function<void()>>{[&] { read_picture(folder / "it.exr"); },
                                                             [&] { read_exr(folder / "it.exr"); },
                                                             [&] { read_exr_bytes(lies, "it.exr"); }}) {
    const std::string words = tests::expect_error(ErrorKind::unreadable_input, read);
    EXPECT_NE(words.find("EXR header"), std::string::npos) << words;
  }
  // It may end beyond what is looked at only where there is more of the file.
  EXPECT_NE(refused(exr.substr(0, 100), exr.size()).find("many megabytes"), std::string::npos);
  EXPECT_NE(refused(exr.substr(0, 100), 100).find("EXR header"), std::string::npos);
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
