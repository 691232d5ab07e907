#include "sim/base/picture/picture_metadata.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "sim/base/error.h"
#include "sim/base/number/random.h"
#include "tests/support/exif_bytes.h"
#include "tests/support/expect_error.h"
#include "tests/support/source_folder.h"

namespace vegard::sim::picture_metadata_test {
namespace {

using tests::ExifMaker;
using M = ExifMaker;

void expect_phone(const PictureMetadata& found) {
  EXPECT_EQ(found.make, "MAKER");
  EXPECT_EQ(found.model, "PHONE 1");
  EXPECT_EQ(found.lens, "LENS 3.95mm");
  EXPECT_EQ(found.exposure_s, 7.5);
  EXPECT_EQ(found.f_number, 1.8);
  EXPECT_EQ(found.iso, 1600.0);
  EXPECT_EQ(found.focal_length_mm, 3.95);
  EXPECT_EQ(found.focal_length_35mm_mm, 27.0);
  EXPECT_EQ(found.taken_local, "2019-03-01T00:16:30.92");
  EXPECT_EQ(found.utc_offset, "-07:00");
  EXPECT_EQ(taken_utc(found), "2019-03-01T07:16:30.92Z");
  EXPECT_EQ(found.gps_time_utc, "2019-03-01T07:16:01Z");
  ASSERT_TRUE(found.latitude_deg && found.longitude_deg);
  EXPECT_NEAR(*found.latitude_deg, 62.0 + 24.0 / 60.0 + 58.5764 / 3600.0, 1e-12);
  EXPECT_NEAR(*found.longitude_deg, -(114.0 + 17.0 / 60.0 + 20.1855 / 3600.0), 1e-12);
  EXPECT_EQ(found.altitude_m, 169.86);
  EXPECT_EQ(found.exif_width_px, 4000);
  EXPECT_EQ(found.exif_height_px, 3000);
}

TEST(PictureMetadata, OfEveryContainerInBothByteOrders) {
  for (const bool big : {false, true}) {
    const std::string exif = tests::phone_exif(big).bytes();
    const PictureMetadata jpeg = picture_metadata_of(tests::jpeg_with_exif(3, 2, exif));
    expect_phone(jpeg);
    EXPECT_EQ(jpeg.width_px, 24);
    EXPECT_EQ(jpeg.height_px, 16);
    const PictureMetadata png =
        picture_metadata_of(tests::png(3, 2, 1, 8, {1, 2, 3, 4, 5, 6}, tests::png_chunk("eXIf", exif)));
    expect_phone(png);
    EXPECT_EQ(png.width_px, 3);
    expect_phone(picture_metadata_of(exif));  // itself a TIFF without a picture
    const PictureMetadata heic = picture_metadata_of(tests::heic_with_exif(exif));
    expect_phone(heic);
    EXPECT_FALSE(heic.width_px);
  }
}

TEST(PictureMetadata, SizeIsThatOfTheUprightPicture) {
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const std::string exif = M(true).shorts(M::kImage, 274, {orientation}).bytes();
    const PictureMetadata found = picture_metadata_of(tests::jpeg_with_exif(3, 2, exif));
    EXPECT_EQ(found.orientation, orientation);
    EXPECT_EQ(found.width_px, orientation >= 5 ? 16 : 24);
    EXPECT_EQ(found.height_px, orientation >= 5 ? 24 : 16);
  }
  // HEIF 6.4.5: its decoder turns the picture by a property of its own.
  const std::string turned = M().shorts(M::kImage, 274, {6}).bytes();
  EXPECT_EQ(picture_metadata_of(tests::heic_with_exif(turned)).orientation, 1);
}

TEST(PictureMetadata, TiffHasASizeAndRawFilesDoNot) {
  tests::Tiff t;
  t.width = 3, t.height = 2, t.orientation = 6;
  const PictureMetadata tiff = picture_metadata_of(tests::tiff(t, std::vector<double>(18, 5)));
  EXPECT_EQ(tiff.width_px, 2);
  EXPECT_EQ(tiff.height_px, 3);
  // The first directory of a DNG is that of a small picture.
  M raw = tests::phone_exif();
  raw.longs(M::kImage, 256, {160}).longs(M::kImage, 257, {120}).longs(M::kImage, 330, {8});
  const PictureMetadata found = picture_metadata_of(raw.bytes());
  expect_phone(found);
  EXPECT_FALSE(found.width_px);
}

TEST(PictureMetadata, WhatCannotBeIsLeftOut) {
  M maker;
  maker.shorts(M::kImage, 274, {0});
  maker.fractions(M::kExif, 33434, {{1, 0}}).fractions(M::kExif, 33437, {{0, 10}});
  maker.shorts(M::kExif, 34855, {65535}).text(M::kExif, 36867, "2019:02:29 00:16:30");
  maker.text(M::kExif, 36881, "+15:00").shorts(M::kExif, 41989, {0}).text(M::kExif, 37386, "long");
  maker.text(M::kGps, 1, "N").fractions(M::kGps, 2, {{95, 1}, {0, 1}, {0, 1}});
  maker.text(M::kGps, 3, "Q").fractions(M::kGps, 4, {{10, 1}, {0, 1}, {0, 1}});
  maker.byte(M::kGps, 5, 7).fractions(M::kGps, 6, {{100, 1}});
  maker.fractions(M::kGps, 7, {{25, 1}, {0, 1}, {0, 1}}).text(M::kGps, 29, "2019:03:01");
  const PictureMetadata found = picture_metadata_of(maker.bytes());
  EXPECT_EQ(found.orientation, 1);
  EXPECT_FALSE(found.exposure_s || found.f_number || found.iso || found.taken_local || found.utc_offset);
  EXPECT_FALSE(found.focal_length_35mm_mm || found.focal_length_mm);
  EXPECT_FALSE(found.latitude_deg || found.longitude_deg || found.altitude_m || found.gps_time_utc);
}

TEST(PictureMetadata, AltitudeBelowTheSeaAndPlacesInTheSouthWest) {
  M maker;
  maker.text(M::kGps, 1, "S").fractions(M::kGps, 2, {{54, 1}, {30, 1}, {0, 1}});
  maker.text(M::kGps, 3, "W").fractions(M::kGps, 4, {{68, 1}, {15, 1}, {0, 1}});
  maker.byte(M::kGps, 5, 1).fractions(M::kGps, 6, {{25, 2}});
  const PictureMetadata found = picture_metadata_of(maker.bytes());
  EXPECT_EQ(found.latitude_deg, -54.5);
  EXPECT_EQ(found.longitude_deg, -68.25);
  EXPECT_EQ(found.altitude_m, -12.5);
}

// A picture's words go into comments and on terminals.
TEST(PictureMetadata, TextsHoldNothingButPrintableCharacters) {
  EXPECT_EQ(picture_metadata_of(M().text(M::kImage, 271, " a\nb\x1b[1m\xc3\xa9 ").bytes()).make, "a?b?[1m??");
  EXPECT_FALSE(picture_metadata_of(M().text(M::kImage, 271, "   ").bytes()).make);
  EXPECT_EQ(picture_metadata_of(M().text(M::kImage, 271, std::string(5000, 'x')).bytes()).make->size(), 200u);
}

// ---- lying and truncated files: no crash, no hang, nothing made up ----

TEST(PictureMetadata, EveryTruncationIsRead) {
  const std::string exif = tests::phone_exif().bytes();
  for (const std::string& whole : {tests::jpeg_with_exif(1, 1, exif), exif, tests::heic_with_exif(exif),
                                   tests::png(1, 1, 1, 8, {1}, tests::png_chunk("eXIf", exif))}) {
    for (std::size_t size = 0; size <= whole.size(); ++size) {
      const PictureMetadata found = picture_metadata_of(std::string_view(whole).substr(0, size));
      // What is found of a part is what the whole says.
      if (found.latitude_deg) {
        EXPECT_NEAR(*found.latitude_deg, 62.4162712, 1e-7) << size;
      }
      if (found.model) {
        EXPECT_EQ(*found.model, std::string("PHONE 1").substr(0, found.model->size())) << size;
      }
      if (found.exposure_s) {
        EXPECT_EQ(*found.exposure_s, 7.5) << size;
      }
    }
  }
}

TEST(PictureMetadata, DirectoriesThatPointAtThemselvesEnd) {
  M maker;
  maker.longs(M::kImage, 34665, {8}).longs(M::kImage, 34853, {8}).text(M::kImage, 271, "LOOP");
  EXPECT_EQ(picture_metadata_of(maker.bytes()).make, "LOOP");
}

TEST(PictureMetadata, CountsAndOffsetsOutOfReachAreNothing) {
  for (const std::uint64_t count : {std::uint64_t{1} << 31, std::uint64_t{0xffffffff}, std::uint64_t{0}}) {
    M maker;
    maker.add(M::kImage, 271, 2, count, std::string("\xf0\xff\xff\xff", 4));
    maker.add(M::kImage, 274, 3, count, std::string("\xf0\xff\xff\xff", 4));
    maker.add(M::kImage, 34665, 4, count == 0 ? 0 : 1, std::string("\xf0\xff\xff\xff", 4));
    const PictureMetadata found = picture_metadata_of(maker.bytes());
    EXPECT_FALSE(found.make) << count;
    EXPECT_EQ(found.orientation, 1) << count;
    EXPECT_FALSE(found.exposure_s);
  }
}

// Seed 6: single bytes of files spoiled one at a time and in heaps. Whether anything reads where it must not
// is for a build with sanitizers to see; here, that it ends and stays inside the limits it promises.
TEST(PictureMetadata, SpoiledBytesDoNoHarm) {
  const std::string exif = tests::phone_exif(true).bytes();
  const std::vector<std::string> wholes = {tests::jpeg_with_exif(1, 1, exif), exif,
                                           tests::heic_with_exif(exif),
                                           tests::png(1, 1, 1, 8, {1}, tests::png_chunk("eXIf", exif))};
  std::uint32_t draw = 0;
  const auto next = [&] { return philox4x32({draw++, 0, 0, 0}, random_key(6))[0]; };
  for (int trial = 0; trial < 4000; ++trial) {
    std::string bytes = wholes[trial % wholes.size()];
    const int spoiled = 1 + static_cast<int>(next() % 12);
    for (int i = 0; i < spoiled; ++i) bytes[next() % bytes.size()] = static_cast<char>(next() >> 8);
    const PictureMetadata found = picture_metadata_of(bytes);
    if (found.latitude_deg) {
      EXPECT_LE(std::abs(*found.latitude_deg), 90.0);
    }
    if (found.longitude_deg) {
      EXPECT_LE(std::abs(*found.longitude_deg), 180.0);
    }
    if (found.exposure_s) {
      EXPECT_GT(*found.exposure_s, 0.0);
    }
    EXPECT_GE(found.orientation, 1);
    EXPECT_LE(found.orientation, 8);
  }
}

TEST(PictureMetadata, OtherFilesSayNothingAndMissingOnesAreRefused) {
  for (const std::string& bytes : {std::string(), std::string("SIMPLE  =                    T"),
                                   std::string("II"), std::string("\xff\xd8", 2), std::string(100, '\0')}) {
    const PictureMetadata found = picture_metadata_of(bytes);
    EXPECT_FALSE(found.make || found.width_px || found.exposure_s);
  }
  tests::expect_error(ErrorKind::unreadable_input, [] { read_picture_metadata("/nowhere/photo.jpg"); });
  const tests::TemporaryFile file("phone.jpg", tests::jpeg_with_exif(3, 2, tests::phone_exif().bytes()));
  expect_phone(read_picture_metadata(file.path()));
}

// A phone's picture of its own making, where the folder of real pictures is at hand.
TEST(PictureMetadata, OfARealPhone) {
  const char* folder = std::getenv("VEGARD_PHOTOS");
  const std::string path =
      (folder != nullptr ? std::string(folder) : tests::source_folder() + "/../shared/photos") +
      "/yellowknife_huawei_2019.jpg";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const PictureMetadata found = read_picture_metadata(path);
  EXPECT_EQ(found.make, "HUAWEI");
  EXPECT_EQ(found.focal_length_35mm_mm, 27.0);
  EXPECT_EQ(found.iso, 1600.0);
  EXPECT_NEAR(*found.exposure_s, 30.0, 0.01);
  EXPECT_EQ(found.gps_time_utc, "2019-03-01T07:16:01Z");
  EXPECT_NEAR(*found.latitude_deg, 62.4163, 1e-4);
  EXPECT_NEAR(*found.longitude_deg, -114.2889, 1e-4);
  EXPECT_EQ(found.orientation, 1);  // the file says 0, which is none
  EXPECT_EQ(found.width_px, 4618);
  EXPECT_EQ(found.height_px, 3464);
}

TEST(TakenUtc, CrossesTheDateAndTheYear) {
  PictureMetadata m;
  m.taken_local = "2019-12-31T22:30:00", m.utc_offset = "-07:30";
  EXPECT_EQ(taken_utc(m), "2020-01-01T06:00:00Z");
  m.taken_local = "2020-03-01T01:00:00.5", m.utc_offset = "+02:00";
  EXPECT_EQ(taken_utc(m), "2020-02-29T23:00:00.5Z");
  m.utc_offset = "Z";
  EXPECT_EQ(taken_utc(m), "2020-03-01T01:00:00.5Z");
  m.utc_offset.reset();
  EXPECT_FALSE(taken_utc(m));
}

}  // namespace
}  // namespace vegard::sim::picture_metadata_test
