#include "fit/photo/photo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "sim/base/error.h"
#include "sim/base/file/sha256.h"
#include "sim/view/sensor/tone_curve.h"
#include "tests/support/image_bytes.h"

namespace vegard::fit::photo_test {
namespace {

using tests::Tiff;

Photo read(const std::string& bytes, const std::string& name, Decoding decoding = Decoding::automatic) {
  const tests::TemporaryFile file(name, bytes);
  return read_photo(file.path(), decoding);
}

/// The stored code of a pixel's channel, back from linear light.
int code(const Photo& photo, int x, int y, int channel = 1) {
  const int largest = (1 << photo.bits) - 1;
  return static_cast<int>(std::lround(sim::srgb_encode(photo.linear.at(x, y, channel)) * largest));
}

std::string four_blocks() { return tests::jpeg_of_blocks(3, 2, {200, 200, 100, 50, 50, 10}); }

// What each orientation of EXIF 2.3 does to a picture of 3 x 2 samples numbered 1 2 3 / 4 5 6, written out by
// hand from the standard's words ("the 0th row is at the visual …").
struct Turned {
  int orientation, width, height;
  std::vector<int> samples;
};
const std::vector<Turned> kTurned = {
    {1, 3, 2, {1, 2, 3, 4, 5, 6}}, {2, 3, 2, {3, 2, 1, 6, 5, 4}}, {3, 3, 2, {6, 5, 4, 3, 2, 1}},
    {4, 3, 2, {4, 5, 6, 1, 2, 3}}, {5, 2, 3, {1, 4, 2, 5, 3, 6}}, {6, 2, 3, {4, 1, 5, 2, 6, 3}},
    {7, 2, 3, {6, 3, 5, 2, 4, 1}}, {8, 2, 3, {3, 6, 2, 5, 1, 4}},
};

void expect_turned(const Photo& photo, const Turned& turned, int block, int per_number) {
  ASSERT_EQ(photo.linear.width, turned.width * block);
  ASSERT_EQ(photo.linear.height, turned.height * block);
  for (int y = 0; y < turned.height; ++y)
    for (int x = 0; x < turned.width; ++x)
      EXPECT_EQ(code(photo, x * block + block / 2, y * block + block / 2),
                per_number * turned.samples[y * turned.width + x])
          << "orientation " << turned.orientation << " at " << x << ", " << y;
}

TEST(ReadPhoto, GreyJpegBecomesThreeEqualLinearChannels) {
  const Photo photo = read(four_blocks(), "grey.jpg");
  ASSERT_EQ(photo.linear.width, 24);
  ASSERT_EQ(photo.linear.height, 16);
  ASSERT_EQ(photo.linear.channel_names, (std::vector<std::string>{"R", "G", "B"}));
  for (int c = 0; c < 3; ++c) {
    EXPECT_FLOAT_EQ(photo.linear.at(4, 4, c), static_cast<float>(sim::srgb_decode(200 / 255.0)));
    EXPECT_FLOAT_EQ(photo.linear.at(20, 12, c), static_cast<float>(sim::srgb_decode(10 / 255.0)));
  }
  EXPECT_EQ(photo.decoding, "sRGB (8-bit JPEG, assumed)");
  EXPECT_EQ(photo.bits, 8);
  EXPECT_EQ(photo.sha256, sim::sha256(four_blocks()));
}

TEST(ReadPhoto, JpegOrientationInBothByteOrders) {
  const std::string jpeg = tests::jpeg_of_blocks(3, 2, {30, 60, 90, 120, 150, 180});
  for (const Turned& turned : kTurned)
    for (const bool big : {false, true}) {
      const std::string exif =
          std::string("Exif\0\0", 6) + tests::exif_with_orientation(turned.orientation, big);
      expect_turned(read(tests::with_app1(jpeg, exif), "turned.jpg"), turned, 8, 30);
    }
}

// OpenCV 4.6 alone looks at the first APP1 segment only and would miss this one.
TEST(ReadPhoto, JpegOrientationBehindAnotherApp1Segment) {
  const std::string jpeg = tests::jpeg_of_blocks(3, 2, {30, 60, 90, 120, 150, 180});
  const std::string exif = std::string("Exif\0\0", 6) + tests::exif_with_orientation(6, true);
  const std::string xmp = std::string("http://ns.adobe.com/xap/1.0/\0<x/>", 33);
  expect_turned(read(tests::with_app1(tests::with_app1(jpeg, exif), xmp), "xmp.jpg"), kTurned[5], 8, 30);
}

TEST(ReadPhoto, PngOrientation) {
  for (const Turned& turned : kTurned) {
    const std::string chunk =
        tests::png_chunk("eXIf", tests::exif_with_orientation(turned.orientation, true));
    expect_turned(read(tests::png(3, 2, 1, 8, {10, 20, 30, 40, 50, 60}, chunk), "turned.png"), turned, 1, 10);
  }
}

// OpenCV turns TIFFs itself; this notices if another version no longer does.
TEST(ReadPhoto, TiffOrientationAtEveryDepth) {
  for (const Turned& turned : kTurned) {
    for (const int bits : {8, 16}) {
      Tiff t;
      t.width = 3, t.height = 2, t.bits = bits, t.orientation = turned.orientation;
      std::vector<double> samples;
      for (int i = 1; i <= 6; ++i) samples.insert(samples.end(), 3, 10.0 * i);
      expect_turned(read(tests::tiff(t, samples), "turned.tif"), turned, 1, 10);
    }
    Tiff t;
    t.width = 3, t.height = 2, t.bits = 32, t.floating = true, t.orientation = turned.orientation;
    t.channels = 1, t.photometric = 1;
    const Photo photo = read(tests::tiff(t, {1, 2, 3, 4, 5, 6}), "turned.tif");
    ASSERT_EQ(photo.linear.width, turned.width);
    for (int i = 0; i < 6; ++i) EXPECT_EQ(photo.linear.data[3 * i], turned.samples[i]);
  }
}

TEST(ReadPhoto, ChannelsComeAsRedGreenBlueAndAlphaIsDropped) {
  const Photo rgb = read(tests::png(1, 1, 3, 8, {10, 20, 30}), "rgb.png");
  const Photo rgba = read(tests::png(1, 1, 4, 16, {1000, 2000, 3000, 400}), "rgba.png");
  const Photo grey_alpha = read(tests::png(1, 1, 2, 8, {40, 3}), "ga.png");
  Tiff t;
  t.width = t.height = 1, t.channels = 4, t.bits = 16;
  const Photo tiff_rgba = read(tests::tiff(t, {1000, 2000, 3000, 400}), "rgba.tif");
  t.bits = 32, t.floating = true;
  const Photo float_rgba = read(tests::tiff(t, {0.5, -0.25, 7.0, 0.1}), "rgba.tif");
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(code(rgb, 0, 0, c), 10 * (c + 1));
    EXPECT_EQ(code(rgba, 0, 0, c), 1000 * (c + 1));
    EXPECT_EQ(code(grey_alpha, 0, 0, c), 40);
    EXPECT_EQ(code(tiff_rgba, 0, 0, c), 1000 * (c + 1));
  }
  EXPECT_EQ(float_rgba.linear.data, (std::vector<float>{0.5f, -0.25f, 7.0f}));
}

// A camera's counts are the same light in every format.
TEST(ReadPhoto, GreyOfMoreThan8BitsIsLinearInEveryFormat) {
  Tiff t;
  t.width = t.height = 1, t.channels = 1, t.bits = 16;
  const Photo tiff = read(tests::tiff(t, {20000}), "a.tif"),
              png = read(tests::png(1, 1, 1, 16, {20000}), "a.png");
  EXPECT_EQ(tiff.decoding, "linear (16-bit TIFF, assumed; --decoding overrides)");
  EXPECT_EQ(png.decoding, "linear (16-bit PNG, assumed; --decoding overrides)");
  for (const Photo& photo : {tiff, png}) {
    EXPECT_FALSE(photo.srgb);
    EXPECT_FLOAT_EQ(photo.linear.at(0, 0, 1), 20000 / 65535.0f);
  }
  EXPECT_EQ(read(tests::png(1, 1, 1, 8, {40}), "b.png").decoding, "sRGB (8-bit PNG, assumed)");
  EXPECT_EQ(read(tests::tiff(t, {20000}), "a.tif", Decoding::srgb).decoding, "sRGB (16-bit TIFF, as asked)");
}

TEST(ReadPhoto, DecodingIsChosenByTheFileOrByTheUser) {
  const std::string integer = tests::png(1, 1, 3, 16, {20000, 30000, 40000});
  const Photo assumed = read(integer, "a.png");
  EXPECT_EQ(assumed.decoding, "sRGB (16-bit PNG, assumed; --decoding overrides)");
  EXPECT_TRUE(assumed.srgb);
  EXPECT_FLOAT_EQ(assumed.linear.at(0, 0, 1), static_cast<float>(sim::srgb_decode(30000 / 65535.0)));
  const Photo linear = read(integer, "a.png", Decoding::linear);
  EXPECT_EQ(linear.decoding, "linear (16-bit PNG, as asked)");
  EXPECT_FLOAT_EQ(linear.linear.at(0, 0, 1), 30000 / 65535.0f);

  Tiff t;
  t.width = t.height = 1, t.bits = 32, t.floating = true;
  const std::string floats = tests::tiff(t, {0.25, 0.5, 2.0});
  EXPECT_EQ(read(floats, "f.tif").decoding, "linear (32-bit float TIFF, assumed)");
  EXPECT_EQ(read(floats, "f.tif").linear.data, (std::vector<float>{0.25f, 0.5f, 2.0f}));
  EXPECT_FLOAT_EQ(read(floats, "f.tif", Decoding::srgb).linear.at(0, 0, 1),
                  static_cast<float>(sim::srgb_decode(0.5)));
}

TEST(ReadPhoto, LargestCodeIsClippedInItsChannelOnly) {
  EXPECT_EQ(read(tests::png(2, 1, 3, 8, {255, 254, 0, 1, 255, 255}), "c.png").usable,
            (std::vector<std::uint8_t>{0, 1, 1, 1, 0, 0}));
  EXPECT_EQ(read(tests::png(1, 1, 3, 16, {65535, 65534, 255}), "c.png").usable,
            (std::vector<std::uint8_t>{0, 1, 1}));
}

TEST(ReadPhoto, WhatIsNotFiniteIsNotUsable) {
  Tiff t;
  t.width = t.height = 1, t.bits = 32, t.floating = true;
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Photo photo = read(tests::tiff(t, {nan, 1.0, inf}), "nan.tif");
  EXPECT_EQ(photo.usable, (std::vector<std::uint8_t>{0, 1, 0}));
  EXPECT_EQ(photo.linear.data, (std::vector<float>{0.0f, 1.0f, 0.0f}));
}

TEST(CodeStep, IsTheSlopeOfTheCurve) {
  Photo photo;
  EXPECT_NEAR(code_step(photo, 0.0), 1.0 / 255 / 12.92, 1e-12);
  // d(linear)/d(stored) = 2.4 / 1.055 * ((s + 0.055) / 1.055)^1.4, here at s = 0.5.
  const double slope = 2.4 / 1.055 * std::pow(0.555 / 1.055, 1.4);
  EXPECT_NEAR(code_step(photo, sim::srgb_decode(0.5)), slope / 255, 1e-6);
  photo.srgb = false, photo.bits = 16;
  EXPECT_NEAR(code_step(photo, 0.3), 1.0 / 65535, 1e-15);
  photo.floating = true;
  EXPECT_EQ(code_step(photo, 0.3), 0.0);
}

// ---- bad input ----

/// The message of the Error(unreadable_input) that reading must throw; it must name the file.
std::string refusal(const std::string& bytes, const std::string& name) {
  const tests::TemporaryFile file(name, bytes);
  try {
    read_photo(file.path(), Decoding::automatic);
  } catch (const sim::Error& error) {
    EXPECT_EQ(error.kind(), sim::ErrorKind::unreadable_input);
    EXPECT_EQ(error.details().file, file.path());
    return error.details().problem;
  }
  return "it was read";
}

bool says(const std::string& text, const std::string& word) {
  if (text.find(word) != std::string::npos) return true;
  ADD_FAILURE() << "'" << text << "' does not say '" << word << "'";
  return false;
}

std::string small_tiff(int bits) {
  Tiff t;
  t.width = 4, t.height = 4, t.bits = bits, t.floating = bits == 32;
  return tests::tiff(t, std::vector<double>(48, 7.0));
}

// Every proper beginning of a file is a truncated file, and each must be refused.
TEST(ReadPhoto, EveryTruncationIsRefused) {
  for (const std::string& whole : {four_blocks(), tests::png(3, 2, 3, 8, std::vector<int>(18, 90)),
                                   small_tiff(8), small_tiff(16), small_tiff(32)}) {
    const tests::TemporaryFile sound("sound", whole);
    EXPECT_NO_THROW(read_photo(sound.path(), Decoding::automatic));
    for (std::size_t size = 8; size < whole.size(); ++size)
      EXPECT_NE(refusal(whole.substr(0, size), "cut"), "it was read") << size << " of " << whole.size();
  }
}

TEST(ReadPhoto, TruncationIsNamed) {
  const std::string jpeg = four_blocks();
  says(refusal(jpeg.substr(0, jpeg.size() - 2), "cut.jpg"), "end-of-image marker is missing");
  const std::string picture = tests::png(3, 2, 3, 8, std::vector<int>(18, 90));
  says(refusal(picture.substr(0, picture.size() - 12), "cut.png"), "PNG end chunk is missing");
  const std::string strips = small_tiff(16);
  says(refusal(strips.substr(0, strips.size() - 1), "cut.tif"), "TIFF strip 1 of 1 reaches beyond the end");
  says(refusal(strips.substr(0, 60), "cut.tif"), "TIFF directory lies beyond the end");
}

TEST(ReadPhoto, BytesAfterTheEndDoNoHarm) {
  EXPECT_EQ(code(read(four_blocks() + "a phone's appendix", "long.jpg"), 4, 4), 200);
}

TEST(ReadPhoto, DamagedPngIsRefused) {
  std::string picture = tests::png(3, 2, 3, 8, std::vector<int>(18, 90));
  picture[picture.size() - 24] ^= 1;
  says(refusal(picture, "damaged.png"), "checksum");
}

TEST(ReadPhoto, WhatIsNoImageIsRefused) {
  says(refusal("", "empty.jpg"), "empty");
  says(refusal("A letter about the northern lights.\n", "letter.jpg"), "no image");
  says(refusal("\xff\xd8", "start.jpg"), "truncated");
  says(refusal("\xff\xd8\xff\xd9", "hollow.jpg"), "without a picture");
  EXPECT_THROW(read_photo("/nowhere/photo.jpg", Decoding::automatic), sim::Error);
  EXPECT_THROW(read_photo(std::filesystem::temp_directory_path().string(), Decoding::automatic), sim::Error);
}

TEST(ReadPhoto, SizesOutOfReachAreRefused) {
  auto png_claiming = [](std::uint64_t width, std::uint64_t height) {
    return "\x89PNG\r\n\x1a\n" +
           tests::png_chunk("IHDR", tests::big_endian(width, 4) + tests::big_endian(height, 4) +
                                        std::string("\x08\x02\0\0\0", 5)) +
           tests::png_chunk("IDAT", "") + tests::png_chunk("IEND", "");
  };
  says(refusal(png_claiming(16385, 16384), "huge.png"), "16385 x 16384");
  says(refusal(png_claiming(0xffffffff, 0xffffffff), "huge.png"), "4294967295 x 4294967295");
  says(refusal(png_claiming(0, 10), "flat.png"), "0 x 10");
  says(refusal(png_claiming(1000001, 1), "wide.png"), "1000001 x 1");
}

TEST(ReadPhoto, KindsThatOpenCvGetsWrongAreRefused) {
  Tiff planar;
  planar.width = planar.height = 2, planar.bits = 16, planar.planar = 2;
  says(refusal(tests::tiff(planar, std::vector<double>(12, 5)), "planar.tif"), "separate planes");
  Tiff negative;
  negative.width = negative.height = 2, negative.channels = 1, negative.photometric = 0;
  says(refusal(tests::tiff(negative, std::vector<double>(4, 5)), "negative.tif"), "neither grey");
  Tiff alpha;
  alpha.width = alpha.height = 1, alpha.channels = 4;
  says(refusal(tests::tiff(alpha, {100, 50, 25, 128}), "alpha.tif"), "transparent");
  EXPECT_EQ(code(read(tests::tiff(alpha, {100, 50, 25, 255}), "opaque.tif"), 0, 0, 0), 100);
}

// ---- masks ----

TEST(ApplyMask, WhiteIsUsedAndClippedStaysOut) {
  Photo photo = read(tests::png(4, 1, 3, 8, {9, 9, 9, 9, 255, 9, 9, 9, 9, 9, 9, 9}), "p.png");
  const std::string bytes = tests::png(4, 1, 1, 8, {255, 128, 127, 0});
  const tests::TemporaryFile mask("mask.png", bytes);
  apply_mask(photo, mask.path());
  EXPECT_EQ(photo.usable, (std::vector<std::uint8_t>{1, 1, 1, 1, 0, 1, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(photo.mask_name, mask.name());
  EXPECT_EQ(photo.mask_sha256, sim::sha256(bytes));
}

// A mask drawn on the picture as a viewer shows it fits, whatever the orientations of the two files.
TEST(ApplyMask, SizesAreComparedAfterOrientation) {
  const std::string turn = tests::png_chunk("eXIf", tests::exif_with_orientation(6, false));
  Photo photo = read(tests::png(3, 2, 1, 8, {1, 2, 3, 4, 5, 6}, turn), "p.png");
  const tests::TemporaryFile upright("mask.png", tests::png(2, 3, 1, 8, {0, 0, 0, 0, 0, 255}));
  apply_mask(photo, upright.path());
  EXPECT_EQ(std::accumulate(photo.usable.begin(), photo.usable.end(), 0), 3);
  EXPECT_EQ(photo.usable[3 * 5], 1);
  const tests::TemporaryFile sideways("mask.png", tests::png(3, 2, 1, 8, std::vector<int>(6, 255)));
  try {
    apply_mask(photo, sideways.path());
    FAIL() << "a mask of another size was taken";
  } catch (const sim::Error& error) {
    EXPECT_EQ(error.kind(), sim::ErrorKind::unreadable_input);
    says(error.what(), "3 x 2");
    says(error.what(), "2 x 3");
  }
}

TEST(ApplyMask, BlackMaskIsRefused) {
  Photo photo = read(tests::png(1, 1, 1, 8, {5}), "p.png");
  const tests::TemporaryFile mask("mask.png", tests::png(1, 1, 1, 8, {0}));
  EXPECT_THROW(apply_mask(photo, mask.path()), sim::Error);
}

}  // namespace
}  // namespace vegard::fit::photo_test
