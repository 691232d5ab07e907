#include "sim/base/picture/fits_io.h"

#include <fitsio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "tests/support/expect_error.h"
#include "tests/support/fits_bytes.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::fits_io_test {
namespace {

using tests::fits_card;
using tests::fits_image;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

FitsImage read(const std::string& bytes) { return read_fits_image(bytes, "it.fits"); }

std::string unreadable(const std::string& bytes) {
  return tests::expect_error(ErrorKind::unreadable_input, [&] { read(bytes); });
}

/// What CFITSIO itself writes through `use`.
template <typename Use>
std::string written(const Use& use) {
  void* buffer = nullptr;
  std::size_t size = 0;
  int status = 0;
  fitsfile* file = nullptr;
  fits_create_memfile(&file, &buffer, &size, 2880, std::realloc, &status);
  use(file, &status);
  fits_flush_file(file, &status);
  LONGLONG header = 0, data = 0, end = 0;
  fits_get_hduaddrll(file, &header, &data, &end, &status);
  EXPECT_EQ(status, 0);
  std::string bytes(static_cast<const char*>(buffer), static_cast<std::size_t>(end));
  fits_close_file(file, &status);
  std::free(buffer);
  return bytes;
}

TEST(FitsIo, UnsignedSixteenBitsWrittenByCfitsio) {
  unsigned short codes[8] = {0, 1, 32767, 32768, 32769, 65534, 65535, 4242};
  const std::string bytes = written([&](fitsfile* file, int* status) {
    long lengths[2] = {4, 2};
    fits_create_img(file, USHORT_IMG, 2, lengths, status);
    fits_write_img(file, TUSHORT, 1, 8, codes, status);
  });
  ASSERT_NE(bytes.find("BZERO   =                32768"), std::string::npos);
  const FitsImage file = read(bytes);
  ASSERT_EQ(file.image.width, 4);
  ASSERT_EQ(file.image.height, 2);
  EXPECT_EQ(file.bits, 16);
  EXPECT_FALSE(file.floating);
  EXPECT_EQ(file.largest, 65535.0);
  EXPECT_EQ(file.step, 1.0);
  // The first row stored is the lowest.
  for (int x = 0; x < 4; ++x) {
    EXPECT_EQ(file.image.at(x, 1, 0), static_cast<float>(codes[x]));
    EXPECT_EQ(file.image.at(x, 0, 0), static_cast<float>(codes[4 + x]));
  }
  for (const auto known : file.known) EXPECT_EQ(known, 1);
}

TEST(FitsIo, EveryKindOfNumber) {
  struct Kind {
    int bitpix;
    std::vector<double> values;
    double largest;
  };
  for (const Kind& kind :
       {Kind{8, {0, 1, 200, 255}, 255.0}, Kind{16, {-32768, -1, 0, 32767}, 32767.0},
        Kind{32, {-16777216, 0, 1, 16777216}, 2147483647.0}, Kind{-32, {-1.5, 0.0, 1e-30, 3e8}, 0.0},
        Kind{-64, {-1.5, 0.0, 0.25, 1e20}, 0.0}}) {
    const FitsImage file = read(fits_image(kind.bitpix, {2, 2}, kind.values));
    EXPECT_EQ(file.bits, std::abs(kind.bitpix));
    EXPECT_EQ(file.floating, kind.bitpix < 0);
    EXPECT_EQ(file.largest, kind.largest);
    for (int i = 0; i < 4; ++i)
      EXPECT_EQ(file.image.at(i % 2, 1 - i / 2, 0), static_cast<float>(kind.values[i])) << kind.bitpix;
  }
}

TEST(FitsIo, ScaleAndZeroGivePhysicalValues) {
  const std::string scaled = fits_card("BSCALE", "0.5") + fits_card("BZERO", "100.");
  const FitsImage file = read(fits_image(16, {2, 1}, {-200, 32767}, scaled));
  EXPECT_EQ(file.image.at(0, 0, 0), 0.0f);
  EXPECT_EQ(file.image.at(1, 0, 0), 16483.5f);
  EXPECT_EQ(file.largest, 16483.5);
  EXPECT_EQ(file.step, 0.5);
  const std::string falling = fits_card("BSCALE", "-1.") + fits_card("BZERO", "0.");
  EXPECT_EQ(read(fits_image(16, {2, 1}, {5, -5}, falling)).largest, 32768.0);
}

TEST(FitsIo, BlankAndNotANumberAreNotKnown) {
  const FitsImage integers = read(fits_image(16, {3, 1}, {7, -999, 9}, fits_card("BLANK", "-999")));
  EXPECT_EQ(integers.known, (std::vector<std::uint8_t>{1, 0, 1}));
  EXPECT_EQ(integers.image.data, (std::vector<float>{7.0f, 0.0f, 9.0f}));
  const double infinity = std::numeric_limits<double>::infinity();
  for (const int bitpix : {-32, -64}) {
    const FitsImage floats = read(fits_image(bitpix, {4, 1}, {1.0, kNan, infinity, -infinity}));
    EXPECT_EQ(floats.known, (std::vector<std::uint8_t>{1, 0, 0, 0}));
    EXPECT_EQ(floats.image.data, (std::vector<float>{1.0f, 0.0f, 0.0f, 0.0f}));
  }
}

TEST(FitsIo, RowsStandAsTheirOrderSays) {
  const std::vector<double> values = {1, 2, 3};
  EXPECT_EQ(read(fits_image(8, {1, 3}, values)).image.data, (std::vector<float>{3, 2, 1}));
  EXPECT_EQ(read(fits_image(8, {1, 3}, values, fits_card("ROWORDER", "'BOTTOM-UP'"))).image.data,
            (std::vector<float>{3, 2, 1}));
  EXPECT_EQ(read(fits_image(8, {1, 3}, values, fits_card("ROWORDER", "'TOP-DOWN'"))).image.data,
            (std::vector<float>{1, 2, 3}));
}

TEST(FitsIo, PlanesBecomeChannels) {
  const FitsImage file = read(fits_image(8, {2, 1, 3}, {1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(file.image.channel_names, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(file.image.data, (std::vector<float>{1, 3, 5, 2, 4, 6}));
  // Axes of length 1 behind the third say nothing.
  EXPECT_EQ(read(fits_image(8, {2, 1, 3, 1}, {1, 2, 3, 4, 5, 6})).image.data, file.image.data);
  EXPECT_NE(unreadable(fits_image(8, {1, 1, 1, 2}, {1, 2})).find("4 axes"), std::string::npos);
}

TEST(FitsIo, TheFirstImageMayStandInAnExtension) {
  unsigned char codes[4] = {10, 20, 30, 40};
  for (const bool compressed : {false, true}) {
    const std::string bytes = written([&](fitsfile* file, int* status) {
      long none = 0, lengths[2] = {2, 2};
      fits_create_img(file, BYTE_IMG, 0, &none, status);
      fits_write_key_str(file, "SITE", "PKR", "", status);
      fits_write_key_str(file, "FILTER", "none", "", status);
      if (compressed) fits_set_compression_type(file, RICE_1, status);
      fits_create_img(file, BYTE_IMG, 2, lengths, status);
      fits_write_key_str(file, "FILTER", "0558", "", status);
      fits_write_img(file, TBYTE, 1, 4, codes, status);
    });
    const FitsImage file = read(bytes);
    EXPECT_EQ(file.image.data, (std::vector<float>{30, 40, 10, 20})) << compressed;
    EXPECT_EQ(file.keywords.at("SITE"), "PKR");
    EXPECT_EQ(file.keywords.at("FILTER"), "0558");
  }
}

/// 16 x 8 numbers i^2 mod 101 in tiles of `width` x `rows`.
template <typename Number>
std::string packed(int algorithm, int type, int code, long width, long rows) {
  return written([&](fitsfile* file, int* status) {
    long lengths[2] = {16, 8}, tile[2] = {width, rows};
    fits_set_compression_type(file, algorithm, status);
    fits_set_tile_dim(file, 2, tile, status);
    fits_create_img(file, type, 2, lengths, status);
    std::vector<Number> values;
    for (int i = 0; i < 128; ++i) values.push_back(static_cast<Number>(i * i % 101));
    fits_write_img(file, code, 1, 128, values.data(), status);
  });
}

TEST(FitsIo, PackedTilesOfAnyHeightAreRead) {
  for (const long width : {10, 16})
    for (const long rows : {1, 3, 4, 8}) {
      const FitsImage file = read(packed<short>(RICE_1, SHORT_IMG, TSHORT, width, rows));
      for (int i = 0; i < 128; ++i) {
        ASSERT_EQ(file.image.at(i % 16, 7 - i / 16, 0), i * i % 101) << rows << ", " << i;
        ASSERT_EQ(file.known[i], 1);
      }
    }
  // Floats are packed as integers in steps of a quarter of their noise, which is a fraction of their range.
  const FitsImage floats = read(packed<float>(RICE_1, FLOAT_IMG, TFLOAT, 16, 4));
  EXPECT_TRUE(floats.floating);
  for (int i = 0; i < 128; ++i) EXPECT_NEAR(floats.image.at(i % 16, 7 - i / 16, 0), i * i % 101, 25.0);
}

TEST(FitsIo, WhatIsPackedOtherwiseIsRefused) {
  for (const int algorithm : {GZIP_1, GZIP_2, HCOMPRESS_1, PLIO_1}) {
    const std::string text = unreadable(packed<short>(algorithm, SHORT_IMG, TSHORT, 16, 8));
    EXPECT_NE(text.find("is not read"), std::string::npos) << text;
    EXPECT_NE(text.find("funpack"), std::string::npos) << text;
  }
}

TEST(FitsIo, LiesAboutPackedTilesAreRefused) {
  const std::string sound = packed<short>(RICE_1, SHORT_IMG, TSHORT, 16, 1);
  const auto with = [&](const std::string& key, const std::string& value) {
    std::string lying = sound;
    const std::size_t at = lying.find(fits_card(key, "").substr(0, 9));
    EXPECT_NE(at, std::string::npos) << key;
    return lying.replace(at, 80, fits_card(key, value));
  };
  // Sizes, parameters of the packing, its columns: CFITSIO goes on for ever over blocks of no pixels.
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, std::string>>{{"ZBITPIX", "64"},
                                                        {"ZNAXIS", "10"},
                                                        {"ZNAXIS1", "0"},
                                                        {"ZNAXIS2", "9"},
                                                        {"ZTILE1", "17"},
                                                        {"ZTILE2", "0"},
                                                        {"ZVAL1", "0"},
                                                        {"ZVAL2", "3"},
                                                        {"TFIELDS", "2"},
                                                        {"TFORM1", "'2PB'"},
                                                        {"TTYPE1", "'UNCOMPRESSED_DATA'"},
                                                        {"NAXIS1", "9"},
                                                        {"NAXIS2", "7"},
                                                        {"PCOUNT", "-1"},
                                                        {"PCOUNT", "40000"}}) {
    SCOPED_TRACE(key + " = " + value);
    unreadable(with(key, value));
  }
  // The table begins the last block but none: eight descriptors of two numbers.
  const std::size_t table = sound.size() - 2880;
  for (const int row : {0, 7}) {
    for (const std::string& lie :
         {tests::fits_numbers(32, {-1, 0}), tests::fits_numbers(32, {0, 0}),
          tests::fits_numbers(32, {21, 2147483647}), tests::fits_numbers(32, {2e9, 0})}) {
      std::string lying = sound;
      const std::string text = unreadable(lying.replace(table + 8 * row, 8, lie));
      EXPECT_NE(text.find("tile " + std::to_string(row + 1)), std::string::npos) << text;
    }
  }
}

TEST(FitsIo, ACutTileIsRefused) {
  const std::string sound = packed<short>(RICE_1, SHORT_IMG, TSHORT, 16, 1);
  const std::size_t table = sound.size() - 2880;
  std::size_t length = 0;
  for (int i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(sound[table + i]);
  ASSERT_GT(length, 3u);
  for (std::size_t less = 1; less < length; ++less) {
    std::string cut = sound;
    cut.replace(table, 4, tests::fits_numbers(32, {static_cast<double>(length - less)}));
    EXPECT_NE(unreadable(cut).find("tile 1 "), std::string::npos) << less;
  }
  // Zeros to the end: CFITSIO goes on behind it.
  std::string zeros = sound;
  unreadable(zeros.replace(table + 8 * 8 + 3, length - 3,
                           std::string(length - 3, '\x10').replace(1, length - 4, length - 4, '\0')));
}

TEST(FitsIo, KeywordsComeAsText) {
  const FitsImage file = read(fits_image(8, {1, 1}, {1},
                                         fits_card("EXPTIME", "1.50000 / seconds") +
                                             fits_card("OBSERVER", "'O''Neil  '") + fits_card("DONE", "T")));
  EXPECT_EQ(file.keywords.at("EXPTIME"), "1.50000");
  EXPECT_EQ(file.keywords.at("OBSERVER"), "O'Neil");
  EXPECT_EQ(file.keywords.at("DONE"), "T");
}

TEST(FitsIo, KeywordsBetweenTheAxesDoNoHarm) {
  const std::string sound = fits_image(16, {3, 1}, {1, 2, 3}, fits_card("SITE", "'PKR'"));
  std::string odd = sound;
  // SIMPLE BITPIX NAXIS NAXIS1 NAXIS2 SITE -> SIMPLE BITPIX NAXIS SITE NAXIS2 NAXIS1
  odd.replace(3 * 80, 80, sound.substr(5 * 80, 80)).replace(5 * 80, 80, sound.substr(3 * 80, 80));
  for (const std::size_t size : {odd.size(), std::size_t{2880 + 6}}) {
    const FitsImage file = read(odd.substr(0, size));
    EXPECT_EQ(file.image.data, (std::vector<float>{1, 2, 3}));
    EXPECT_EQ(file.keywords.at("SITE"), "PKR");
  }
  EXPECT_NE(unreadable(odd.substr(0, 2880 + 5)).find("truncated"), std::string::npos);
}

TEST(FitsIo, WhatIsWrittenComesBackBitForBit) {
  Image image(3, 2, {"a", "b"});
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = 0.1f * static_cast<float>(i) - 0.3f;
  image.at(2, 1, 1) = std::numeric_limits<float>::quiet_NaN();
  const std::vector<FitsKeyword> words = {{"SITE", std::string("it's here"), "where"}, {"GLAT", 0.1, "deg"}};
  const std::string bytes = encode_fits(image, words);
  EXPECT_EQ(bytes.size() % 2880, 0u);
  EXPECT_EQ(bytes, encode_fits(image, words));
  const FitsImage back = read(bytes);
  ASSERT_EQ(back.image.width, 3);
  ASSERT_EQ(back.image.height, 2);
  ASSERT_EQ(back.image.channels(), 2);
  EXPECT_EQ(back.keywords.at("SITE"), "it's here");
  EXPECT_EQ(std::stod(back.keywords.at("GLAT")), 0.1);
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    EXPECT_EQ(back.known[i], !std::isnan(image.data[i]));
    EXPECT_EQ(back.image.data[i], back.known[i] ? image.data[i] : 0.0f);
  }
}

TEST(FitsIo, AnOutputIsNotReplacedUnasked) {
  const tests::TemporaryFolder folder;
  const Image image(1, 1, {"Y"});
  write_fits(folder / "a.fits", image, {});
  tests::expect_error(ErrorKind::existing_output, [&] { write_fits(folder / "a.fits", image, {}); });
  EXPECT_EQ(read(tests::bytes_of(folder / "a.fits")).image.width, 1);
}

TEST(FitsIo, ATablesNumbersAreRead) {
  double x[3] = {1.5, -2.0, 1e300};
  int n[3] = {1, -2, 3};
  const std::string bytes = written([&](fitsfile* file, int* status) {
    char* names[4] = {const_cast<char*>("field_x"), const_cast<char*>("name"), const_cast<char*>("n"),
                      const_cast<char*>("pair")};
    char* forms[4] = {const_cast<char*>("1D"), const_cast<char*>("4A"), const_cast<char*>("1J"),
                      const_cast<char*>("2E")};
    fits_create_tbl(file, BINARY_TBL, 3, 4, names, forms, nullptr, nullptr, status);
    fits_write_col(file, TDOUBLE, 1, 1, 1, 3, x, status);
    fits_write_col(file, TINT, 3, 1, 1, 3, n, status);
  });
  const FitsTable table = read_fits_table(bytes, "stars.corr");
  ASSERT_EQ(table.columns.size(), 2u);
  EXPECT_EQ(table.columns.at("field_x"), (std::vector<double>{1.5, -2.0, 1e300}));
  EXPECT_EQ(table.columns.at("n"), (std::vector<double>{1, -2, 3}));
  EXPECT_NE(unreadable(bytes).find("no image"), std::string::npos);
  const std::string header = bytes.substr(0, 2880 * 2);
  const std::string words =
      tests::expect_error(ErrorKind::unreadable_input, [&] { read_fits_table(header, "stars.corr"); });
  EXPECT_NE(words.find("truncated"), std::string::npos) << words;
  tests::expect_error(ErrorKind::unreadable_input, [] {
    read_fits_table(fits_image(8, {1, 1}, {1}), "stars.corr");
  });
}

TEST(FitsIo, EveryTruncationIsRefused) {
  const std::string whole = fits_image(16, {4, 2}, {1, 2, 3, 4, 5, 6, 7, 8});
  ASSERT_EQ(read(whole).image.data[0], 5.0f);
  // Of the filling of the last block nothing is needed.
  ASSERT_EQ(read(whole.substr(0, 2880 + 16)).image.data[7], 4.0f);
  for (std::size_t size = 0; size < 2880 + 16; size += size < 2700 ? 97 : 1)
    EXPECT_FALSE(unreadable(whole.substr(0, size)).empty()) << size;
  EXPECT_NE(unreadable(whole.substr(0, 2880 + 15)).find("truncated"), std::string::npos);
}

TEST(FitsIo, PromisesAreRefusedBeforeMemoryIsAskedFor) {
  for (const auto& axes : std::vector<std::vector<long long>>{{40000, 40000}, {2000000, 1}, {0, 5}})
    EXPECT_NE(unreadable(tests::fits_header(16, axes)).find(std::to_string(axes[0]) + " x "),
              std::string::npos);
  EXPECT_NE(unreadable(tests::fits_header(16, {10000, 10000, 1000})).find("1000 planes"), std::string::npos);
  EXPECT_NE(unreadable(tests::fits_header(16, {10000, 10000})).find("truncated"), std::string::npos);
}

TEST(FitsIo, ASizeThatIsNoNumberIsRefusedInEveryHeader) {
  const std::string image = fits_image(16, {4, 2}, {1, 2, 3, 4, 5, 6, 7, 8});
  const auto with = [](std::string bytes, const std::string& key, const std::string& value) {
    const std::size_t card = bytes.rfind(key + std::string(8 - key.size(), ' ') + "=");
    EXPECT_NE(card, std::string::npos) << key;
    return bytes.replace(card + 10, 70, value + std::string(70 - value.size(), ' '));
  };
  for (const std::string key : {"BITPIX", "NAXIS", "NAXIS1", "NAXIS2"}) {
    EXPECT_NE(unreadable(with(image, key, "'          2")).find(key + " is no whole number"),
              std::string::npos);
    EXPECT_NE(unreadable(with(image, key, "")).find(key + " is no whole number"), std::string::npos);
  }
  EXPECT_EQ(read(with(image, "NAXIS2", "+2 / rows")).image.height, 2);

  // In the second header, behind data.
  const std::string table = written([](fitsfile* file, int* status) {
    LONGLONG lengths[2] = {4, 2};
    fits_create_imgll(file, SHORT_IMG, 2, lengths, status);
    char* names[1] = {const_cast<char*>("x")};
    char* forms[1] = {const_cast<char*>("1J")};
    fits_create_tbl(file, BINARY_TBL, 3, 1, names, forms, nullptr, nullptr, status);
  });
  EXPECT_EQ(read_fits_table(table, "stars.corr").columns.at("x").size(), 3u);
  for (const std::string key : {"NAXIS2", "PCOUNT", "GCOUNT", "TFIELDS"}) {
    const std::string words = tests::expect_error(ErrorKind::unreadable_input, [&] {
      read_fits_table(with(table, key, "'          2"), "stars.corr");
    });
    EXPECT_NE(words.find(key + " is no whole number"), std::string::npos) << words;
  }
  // An extension begins with its sizes, and ends.
  const auto refused = [](const std::string& bytes) {
    return tests::expect_error(ErrorKind::unreadable_input, [&] { read_fits_table(bytes, "stars.corr"); });
  };
  std::string renamed = table;
  renamed.replace(renamed.rfind("BITPIX  ="), 6, "BITPIZ");
  EXPECT_NE(refused(renamed).find("BITPIX"), std::string::npos);
  std::string endless = table;
  const std::size_t end = endless.rfind("END" + std::string(77, ' '));
  ASSERT_NE(end, std::string::npos);
  endless.replace(end, 3, "   ");
  EXPECT_NE(refused(endless).find("has no END"), std::string::npos);
}

TEST(FitsIo, WhatIsNoFitsImageIsRefused) {
  EXPECT_NE(unreadable("").find("no FITS"), std::string::npos);
  EXPECT_NE(unreadable(tests::fits_header(16, {})).find("no image"), std::string::npos);
  EXPECT_FALSE(unreadable(tests::fits_header(17, {1, 1})).empty());
  EXPECT_FALSE(unreadable(tests::fits_header(16, {-3, 1})).empty());
}

}  // namespace
}  // namespace vegard::sim::fits_io_test
