#include "sim/base/picture/picture_signature.h"

#include <gtest/gtest.h>

namespace vegard::sim::picture_signature_test {
namespace {

using namespace std::string_view_literals;

TEST(PictureSignature, KnowsTheFormatsThatPhotographsHave) {
  EXPECT_EQ(picture_format_of("\xff\xd8\xff\xe1\0\0Exif\0\0II*\0"sv), "JPEG");
  EXPECT_EQ(picture_format_of("\x89PNG\r\n\x1a\n\0\0\0\rIHDR"sv), "PNG");
  EXPECT_EQ(picture_format_of("II*\0\x08\0\0\0"sv), "TIFF or raw");
  EXPECT_EQ(picture_format_of("MM\0*\0\0\0\x08"sv), "TIFF or raw");
  EXPECT_EQ(picture_format_of("SIMPLE  =               "sv), "FITS");
  EXPECT_EQ(picture_format_of("\0\0\0\x18"
                              "ftypheic\0\0"sv),
            "HEIC");
  EXPECT_EQ(picture_format_of("\x76\x2f\x31\x01\x02\0\0\0"sv), "EXR");
  EXPECT_EQ(picture_format_of("P5\n64 48\n255\n"sv), "PNM");
  EXPECT_EQ(picture_format_of("RIFF\x10\0\0\0WEBPVP8 "sv), "WebP");
}

TEST(PictureSignature, TextsAreNoPictures) {
  for (const std::string_view text :
       {""sv, "# a scene\n"sv, "seed = 3\n"sv, "[camera]\nwidth = 64\n"sv, "P5 = 3\n"sv, "BM = 1 # four"sv,
        "SIMPLE = 1\n"sv, "II = 2\n"sv, "x_px,y_px,star\n"sv, "\xef\xbb\xbf[site]"sv})
    EXPECT_EQ(picture_format_of(text), "") << text;
}

}  // namespace
}  // namespace vegard::sim::picture_signature_test
