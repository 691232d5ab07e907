// What comes in besides JPEG, PNG and TIFF: known values, promises that are not kept, and cut files.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>

#include "fit/photo/photo.h"
#include "sim/base/file/sha256.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/image_io.h"
#include "sim/view/sensor/tone_curve.h"
#include "tests/support/dng_bytes.h"
#include "tests/support/expect_error.h"
#include "tests/support/fits_bytes.h"
#include "tests/support/source_folder.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::photo_formats_test {
namespace {

Photo read(const std::string& bytes, Decoding decoding = Decoding::automatic) {
  return read_photo_bytes(bytes, "folder/it", decoding);
}

std::string refusal(const std::string& bytes) {
  return tests::expect_error(sim::ErrorKind::unreadable_input, [&] { read(bytes); });
}

void says(const std::string& text, const std::string& words) {
  EXPECT_NE(text.find(words), std::string::npos) << text;
  EXPECT_EQ(text.rfind("folder/it: ", 0), 0u) << text;
}

using Bytes = std::vector<std::uint8_t>;

std::string data_file(const std::string& name) {
  return tests::bytes_of(tests::source_folder() + "/tests/data/" + name);
}

// ---- JPEG ----

TEST(ReadJpeg, SaysWhatItsCompressionPutsUponBlocks) {
  // Blocks of random low frequencies (seed 7), each of which the file rounds by itself: what is read differs
  // from what was written by as much as the file's tables say. 384 x 384 pixels in 2304 blocks of six
  // coefficients: the root mean square is known to a per cent. Encoding rounds luma and chroma, and the 57
  // other frequencies of that are lost with the coarse steps of quality 50; 5 % are left for it.
  constexpr int kBlocks = 48, kSide = 8 * kBlocks;
  sim::Image picture(kSide, kSide, {"R", "G", "B"});
  std::mt19937 random(7);
  const int waves[6][2] = {{0, 0}, {0, 1}, {1, 0}, {2, 0}, {1, 1}, {0, 2}};
  for (int block = 0; block < kBlocks * kBlocks; ++block)
    for (int c = 0; c < 3; ++c) {
      double amplitude[6];
      for (double& a : amplitude) a = 0.16 * (random() / 4294967296.0 - 0.5);
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
          double value = 0.5;
          for (int k = 0; k < 6; ++k)
            value += amplitude[k] * std::cos(3.14159265358979 * waves[k][0] * (2 * x + 1) / 16.0) *
                     std::cos(3.14159265358979 * waves[k][1] * (2 * y + 1) / 16.0);
          picture.at(block % kBlocks * 8 + x, block / kBlocks * 8 + y, c) = static_cast<float>(value);
        }
    }
  const Photo photo = read(sim::encode_display(sim::ImageFormat::jpeg, picture, 8, 50, {}), Decoding::linear);
  // Tables K.1 and K.2 of ITU-T T.81, which libjpeg has at quality 50: 16 11 12 14 12 10 and 17 18 18 24 21
  // 24; sums of squares 961 and 2530.
  const double luma = 961.0 / 768.0, chroma = 2530.0 / 768.0, rounding = 1.0 / 12.0;
  EXPECT_NEAR(photo.block_error[0], std::sqrt(luma + 1.402 * 1.402 * chroma + rounding), 1e-3);
  EXPECT_NEAR(photo.block_error[1], std::sqrt(luma + (0.3441 * 0.3441 + 0.7141 * 0.7141) * chroma + rounding),
              1e-3);
  EXPECT_NEAR(photo.block_error[2], std::sqrt(luma + 1.772 * 1.772 * chroma + rounding), 1e-3);
  for (int c = 0; c < 3; ++c) {
    double squares = 0.0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x)
        squares += std::pow(255.0 * (photo.linear.at(x, y, c) - picture.at(x, y, c)), 2);
    EXPECT_NEAR(std::sqrt(squares / (kSide * kSide)) / photo.block_error[c], 1.0, 0.05) << c;
  }
}

TEST(ReadJpeg, FormatsThatLoseNothingHaveNoSuchError) {
  const Photo photo =
      read(sim::encode_display(sim::ImageFormat::png, sim::Image(4, 4, {"R", "G", "B"}), 8, 0, {}));
  EXPECT_EQ(photo.block_error, (std::array<double, 3>{}));
}

// ---- FITS ----

TEST(ReadFits, UnsignedSixteenBitsAreLinearAndFullAtTheirEnd) {
  const std::string bytes =
      tests::fits_image(16, {4, 2}, {-32768, -32767, 0, 1, 32766, 32767, -1, 100},
                        tests::fits_card("BZERO", "32768") + tests::fits_card("EXPTIME", "1.5"));
  const Photo photo = read(bytes);
  ASSERT_EQ(photo.linear.width, 4);
  ASSERT_EQ(photo.linear.height, 2);
  const int codes[2][4] = {{65534, 65535, 32767, 32868}, {0, 1, 32768, 32769}};
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x)
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(photo.linear.at(x, y, c), static_cast<float>(codes[y][x] / 65535.0));
        EXPECT_EQ(photo.usable[photo.linear.index(x, y, c)], codes[y][x] < 65535);
      }
  EXPECT_EQ(photo.decoding, "linear (16-bit FITS, assumed)");
  EXPECT_EQ(file_step(photo), 1.0 / 65535);
  EXPECT_EQ(photo.words.at("EXPTIME"), "1.5");
  EXPECT_EQ(photo.file_name, "it");
  EXPECT_EQ(photo.sha256, sim::sha256(bytes));
}

TEST(ReadFits, PlanesAreColoursAndKeywordsSayWhatIsFull) {
  const Photo colours = read(tests::fits_image(8, {1, 1, 3}, {51, 102, 153}));
  EXPECT_EQ(colours.linear.data, (std::vector<float>{0.2f, 0.4f, 0.6f}));
  const std::string full = tests::fits_card("SATURATE", "1000.");
  const Photo cut = read(tests::fits_image(16, {3, 1}, {500, 999, 1000}, full));
  EXPECT_EQ(cut.usable, (Bytes{1, 1, 1, 1, 1, 1, 0, 0, 0}));
  EXPECT_EQ(cut.linear.at(0, 0, 0), 0.5f);
  EXPECT_EQ(file_step(cut), 0.001);
  const std::string nothing = tests::fits_card("SATURATE", "1e-308");
  const Photo sound = read(tests::fits_image(16, {2, 1}, {0, 1000}, nothing));
  EXPECT_EQ(sound.usable, (Bytes{1, 1, 1, 1, 1, 1})) << "no white below the first step above zero";
  EXPECT_EQ(file_step(sound), 1.0 / 32767);
  const Photo valid = read(tests::fits_image(-32, {2, 1}, {7.0, 8.0}, tests::fits_card("DATAMAX", "7.")));
  EXPECT_EQ(valid.usable, (Bytes{1, 1, 1, 0, 0, 0}));
  EXPECT_EQ(valid.linear.at(0, 0, 0), 7.0f);
  EXPECT_TRUE(valid.floating);
}

TEST(ReadFits, WhatIsNotKnownIsNotUsable) {
  const Photo photo = read(tests::fits_image(16, {2, 1}, {-5, 7}, tests::fits_card("BLANK", "-5")));
  EXPECT_EQ(photo.usable, (Bytes{0, 0, 0, 1, 1, 1}));
  says(refusal(tests::fits_image(8, {1, 1, 2}, {1, 2})), "2 planes");
}

/// Where pictures to try the program on are; they are no part of it.
std::string photos_folder() {
  const char* named = std::getenv("VEGARD_PHOTOS");
  return named != nullptr ? named : tests::source_folder() + "/../shared/photos";
}

TEST(ReadFits, ImagersFilesAsTheyAre) {
  const std::string folder = photos_folder() + "/dasc/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "there are no pictures in " << folder;
  const Photo photo = read_photo(folder + "dasc_PKR_DASC_0558_20151007_082351.743.FITS", Decoding::automatic);
  EXPECT_EQ(photo.linear.width, 512);
  EXPECT_EQ(photo.words.at("SITE"), "PKR");
  EXPECT_EQ(photo.words.at("FILTWAV"), "0558");
  EXPECT_EQ(std::stod(photo.words.at("GLAT")), 65.126);
  const Photo azimuth = read_photo(folder + "PKR_DASC_0558_20150213_Az.FIT", Decoding::automatic);
  EXPECT_TRUE(azimuth.floating);
  EXPECT_EQ(azimuth.linear.width, 512);
}

// ---- PGM and PPM ----

TEST(ReadPnm, EightBitsAreTakenForSrgbAndMoreOfGreyForLinear) {
  const Photo eight = read("P5\n# a remark\n2 1\n255\n" + std::string("\x64\xff", 2));
  EXPECT_EQ(eight.decoding, "sRGB (8-bit PGM, assumed)");
  EXPECT_EQ(eight.linear.at(0, 0, 1), static_cast<float>(sim::srgb_decode(100 / 255.0)));
  EXPECT_EQ(eight.usable, (Bytes{1, 1, 1, 0, 0, 0}));
  const Photo twelve = read("P5 2 1 4095\n" + tests::big_endian(1024, 2) + tests::big_endian(4095, 2));
  EXPECT_EQ(twelve.decoding, "linear (12-bit PGM, assumed; --decoding overrides)");
  EXPECT_EQ(twelve.linear.at(0, 0, 2), static_cast<float>(1024 / 4095.0));
  EXPECT_EQ(twelve.usable, (Bytes{1, 1, 1, 0, 0, 0}));
  EXPECT_EQ(file_step(twelve), 1.0 / 4095);
  const Photo asked = read("P5 1 1 65535 " + tests::big_endian(30000, 2), Decoding::srgb);
  EXPECT_EQ(asked.linear.at(0, 0, 0), static_cast<float>(sim::srgb_decode(30000 / 65535.0)));
}

TEST(ReadPnm, ColoursOfMoreThan8BitsAreTakenForSrgbAsInPngAndTiff) {
  const std::string file = "P6 1 1 65535\n" + tests::big_endian(20000, 2) + tests::big_endian(30000, 2) +
                           tests::big_endian(40000, 2);
  const Photo colours = read(file);
  EXPECT_EQ(colours.decoding, "sRGB (16-bit PPM, assumed; --decoding overrides)");
  EXPECT_EQ(colours.linear.at(0, 0, 1), static_cast<float>(sim::srgb_decode(30000 / 65535.0)));
  EXPECT_FALSE(read(file, Decoding::linear).srgb);
}

TEST(ReadPnm, ColoursAndWords) {
  const Photo colours =
      read("P6 1 1 65535\n" + tests::big_endian(1, 2) + tests::big_endian(2, 2) + tests::big_endian(65534, 2),
           Decoding::linear);
  EXPECT_EQ(colours.linear.data,
            (std::vector<float>{static_cast<float>(1 / 65535.0), static_cast<float>(2 / 65535.0),
                                static_cast<float>(65534 / 65535.0)}));
  const Photo words = read("P3\n1 2 1000\n0 500 1000 # half\n1 2 3\n", Decoding::linear);
  EXPECT_EQ(words.linear.at(0, 0, 1), 0.5f);
  EXPECT_EQ(words.linear.at(0, 1, 2), 0.003f);
  EXPECT_EQ(words.usable, (Bytes{1, 1, 0, 1, 1, 1}));
  EXPECT_EQ(read("P2 1 1 500 250").linear.at(0, 0, 0), 0.5f);
}

TEST(ReadPnm, LiesAreRefused) {
  says(refusal("P5 40000 40000 255\n"), "40000 x 40000");
  says(refusal("P5 0 1 255\n"), "0 x 1");
  says(refusal("P5 99999999999999999999 1 255\n"), "along a side");
  says(refusal("P5 2 2 255\nabc"), "truncated");
  says(refusal("P2 2 1 255\n12"), "truncated");
  says(refusal("P2 2 1 255\n1 x"), "else than numbers");
  says(refusal("P2 1 1 255\n256"), "above");
  says(refusal("P5 1 1 70000\nab"), "largest value is 70000");
  says(refusal("P5 one 1 255\na"), "no width");
  says(refusal("P6 3"), "truncated");
}

// ---- EXR ----

std::string exr(const std::vector<std::string>& channels, const std::vector<float>& values) {
  sim::Image image(static_cast<int>(values.size() / channels.size()), 1, channels);
  image.data = values;
  return sim::encode_exr({&image}, {{"units", "what they are"}});
}

TEST(ReadExr, ColoursGreyAndWhatIsNotFinite) {
  const Photo colours = read(exr({"R", "G", "B", "rayleigh.557.7"}, {-0.25f, 2.0f, 0.5f, 9.0f}));
  EXPECT_EQ(colours.linear.data, (std::vector<float>{-0.25f, 2.0f, 0.5f}));
  EXPECT_EQ(colours.decoding, "linear (float EXR, assumed)");
  EXPECT_TRUE(keeps_negative_light(colours));
  EXPECT_EQ(colours.words.at("units"), "what they are");
  const Photo grey = read(exr({"Y"}, {0.125f, std::numeric_limits<float>::infinity()}));
  EXPECT_EQ(grey.linear.data, (std::vector<float>{0.125f, 0.125f, 0.125f, 0.0f, 0.0f, 0.0f}));
  EXPECT_EQ(grey.usable, (Bytes{1, 1, 1, 0, 0, 0}));
  says(refusal(exr({"rayleigh.557.7", "rayleigh.630.0"}, {1.0f, 2.0f})), "no picture");
}

TEST(ReadExr, EveryTruncationAndALyingHeaderAreRefused) {
  const std::string whole = exr({"R", "G", "B"}, {0.1f, 0.2f, 0.3f});
  for (std::size_t size = 4; size < whole.size(); size += 3) says(refusal(whole.substr(0, size)), "it: ");
  std::string lying = whole;
  const std::size_t window = lying.find("dataWindow") + std::string("dataWindow box2i ").size() + 4;
  lying.replace(window + 8, 8, tests::little_endian(39999, 4) + tests::little_endian(39999, 4));
  says(refusal(lying), "40000 x 40000");
}

// ---- camera raw ----

/// Sites of one colour each: red 10000, green 20000, blue 40000.
std::vector<int> even_sites(const tests::Dng& d) {
  std::vector<int> sites;
  for (int y = 0; y < d.height; ++y)
    for (int x = 0; x < d.width; ++x) sites.push_back(10000 << ((x & 1) + (y & 1)));
  return sites;
}

TEST(ReadCameraRaw, NumbersAreLinearWithoutAnyBalance) {
  const Photo photo = read(tests::dng({}, even_sites({})));
  ASSERT_EQ(photo.linear.width, 32);
  ASSERT_EQ(photo.linear.height, 24);
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 32; ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(photo.linear.at(x, y, c), static_cast<float>((10000 << c) / 65535.0)) << x << ", " << y;
  EXPECT_EQ(photo.decoding.rfind("linear (camera raw by LibRaw ", 0), 0u) << photo.decoding;
  EXPECT_EQ(file_step(photo), 1.0 / 65535);
}

TEST(ReadCameraRaw, BlackAndWhiteLevelsAreTheEnds) {
  tests::Dng levels;
  levels.black = 1000, levels.white = 5000;
  std::vector<int> sites = even_sites(levels);
  for (int& site : sites) site = 1000 + site / 20;  // 500, 1000, 2000 of 4000
  const Photo photo = read(tests::dng(levels, sites));
  // LibRaw cuts off what is behind the point, of 16 bits.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(photo.linear.at(9, 9, c), 0.125 * (1 << c), 1.0 / 65535);
}

TEST(ReadCameraRaw, AFullSiteSpoilsItsColourAroundIt) {
  std::vector<int> sites = even_sites({});
  sites[10 * 32 + 10] = 65535;  // red
  const Photo photo = read(tests::dng({}, sites));
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 32; ++x)
      for (int c = 0; c < 3; ++c) {
        const bool near = std::abs(x - 10) <= 1 && std::abs(y - 10) <= 1 && c == 0;
        ASSERT_EQ(photo.usable[photo.linear.index(x, y, c)], near ? 0 : 1) << x << ", " << y << ", " << c;
        if (near) continue;
        ASSERT_EQ(photo.linear.at(x, y, c), static_cast<float>((10000 << c) / 65535.0));
      }
}

TEST(ReadCameraRaw, ItIsTurnedOnce) {
  tests::Dng turned;
  turned.orientation = 6;  // the first row is at the right
  std::vector<int> sites = even_sites(turned);
  sites[2 * 32 + 4] = 30000;  // red, at x = 4, y = 2
  const Photo photo = read(tests::dng(turned, sites));
  ASSERT_EQ(photo.linear.width, 24);
  ASSERT_EQ(photo.linear.height, 32);
  EXPECT_EQ(photo.linear.at(24 - 1 - 2, 4, 0), static_cast<float>(30000 / 65535.0));
}

TEST(ReadCameraRaw, CutAndLyingFilesAreRefused) {
  const std::string whole = tests::dng({}, even_sites({}));
  says(refusal(whole.substr(0, whole.size() - 1)), "truncated");
  for (std::size_t size = 16; size < whole.size(); size += 61) says(refusal(whole.substr(0, size)), "it: ");
  tests::Dng huge;
  huge.claimed_width = huge.claimed_height = 40000;
  says(refusal(tests::dng(huge, even_sites({}))), "40000 x 40000");
  tests::Dng speck;
  speck.width = speck.height = 1;
  says(refusal(tests::dng(speck, {500})), "cannot be read");  // LibRaw takes none below 22 pixels
}

// ---- HEIC ----
// tests/data/quarters.heic: 64 x 32 pixels, quarters of 40, 90 / 150, 220; turned.heic: the same with the
// property that turns it by 90 degrees, anticlockwise.

void expect_quarters(const Photo& photo, const std::vector<int>& codes) {
  for (int i = 0; i < 4; ++i) {
    const int x = photo.linear.width * (1 + 2 * (i % 2)) / 4, y = photo.linear.height * (1 + 2 * (i / 2)) / 4;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(255.0 * sim::srgb_encode(photo.linear.at(x, y, c)), codes[i], 2.0) << i;  // it is lossy
  }
}

TEST(ReadHeic, ItIsDecodedAndTurnedOnce) {
  const Photo photo = read(data_file("quarters.heic"));
  ASSERT_EQ(photo.linear.width, 64);
  ASSERT_EQ(photo.linear.height, 32);
  expect_quarters(photo, {40, 90, 150, 220});
  EXPECT_EQ(photo.decoding.rfind("sRGB (8-bit HEIC by libheif ", 0), 0u) << photo.decoding;
  const Photo turned = read(data_file("turned.heic"));
  ASSERT_EQ(turned.linear.width, 32);
  ASSERT_EQ(turned.linear.height, 64);
  expect_quarters(turned, {90, 220, 40, 150});
}

TEST(ReadHeic, CutAndLyingFilesAreRefused) {
  const std::string whole = data_file("quarters.heic");
  ASSERT_GT(whole.size(), 100u);
  for (std::size_t size = 12; size < whole.size(); size += 7) says(refusal(whole.substr(0, size)), "it: ");
  says(refusal(whole.substr(0, whole.size() - 1)), "truncated");
  std::string lying = whole;
  const std::size_t size = lying.find("ispe") + 8;
  lying.replace(size, 8, tests::big_endian(40000, 4) + tests::big_endian(40000, 4));
  says(refusal(lying), "40000 x 40000");
}

// The library reads as many rows as the header promises, whether the tiles have them or not.
TEST(ReadHeic, TilesOfAnotherSizeThanPromisedAreRefused) {
  for (const char* name : {"quarters.heic", "turned.heic"}) {
    const std::string whole = data_file(name);
    const std::size_t size =
        whole.rfind("ispe") + 8;  // of what the tiles make; before it stands that of a tile
    for (const auto& [width, height] : {std::pair{64, 64}, {12352, 32}, {64, 16}}) {
      std::string lying = whole;
      lying.replace(size, 8, tests::big_endian(width, 4) + tests::big_endian(height, 4));
      says(refusal(lying), "put together of tiles to another size");
    }
    std::string other = whole;  // a kind of picture whose size nothing tells
    other.replace(other.find("grid"), 4, "iovl");
    says(refusal(other), "neither an HEVC stream nor put together of tiles");
    std::string twice = whole;
    twice.replace(twice.find("idat"), 4, "pitm");
    says(refusal(twice), "two boxes pitm");
  }
}

// ---- all of them ----

TEST(ReadPhotoBytes, OnePixelIsAPicture) {
  for (const std::string& bytes : {tests::fits_image(16, {1, 1}, {5}), std::string("P2 1 1 255 5"),
                                   exr({"Y"}, {0.5f}), tests::png(1, 1, 1, 8, {5})}) {
    const Photo photo = read(bytes);
    EXPECT_EQ(photo.linear.width * photo.linear.height, 1);
    EXPECT_EQ(photo.usable, (Bytes{1, 1, 1}));
  }
}

TEST(ReadPhotoBytes, AHeaderAloneAsksForNoMemory) {
  tests::Tiff huge;
  huge.width = huge.height = 40000;
  says(refusal(tests::tiff(huge, {1, 2, 3})), "40000 x 40000");
  says(refusal(tests::fits_header(16, {40000, 40000})), "40000 x 40000");
  std::string jpeg = tests::jpeg_of_blocks(1, 1, {50});
  const std::size_t frame = jpeg.find("\xff\xc0") + 5;
  jpeg.replace(frame, 4, tests::big_endian(40000, 2) + tests::big_endian(40000, 2));
  says(refusal(jpeg), "40000 x 40000");
}

}  // namespace
}  // namespace vegard::fit::photo_formats_test
