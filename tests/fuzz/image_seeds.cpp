// Small pictures of every format to begin with, plain and compressed.
#include <fitsio.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "sim/base/picture/image_io.h"
#include "tests/fuzz/target.h"
#include "tests/support/dng_bytes.h"
#include "tests/support/exif_bytes.h"
#include "tests/support/fits_bytes.h"
#include "tests/support/frames/gzip_bytes.h"
#include "tests/support/frames/made_frames.h"
#include "tests/support/image_bytes.h"

namespace vegard::tests {
namespace {

sim::Image gradient(int width, int height, const std::vector<std::string>& channels) {
  sim::Image image(width, height, channels);
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<float>(i % 97) / 96.0f;
  return image;
}

/// 16 x 8 pixels in tiles of 16 x 4.
std::string packed_fits(int algorithm, int type) {
  void* buffer = nullptr;
  std::size_t size = 0;
  int status = 0;
  fitsfile* file = nullptr;
  fits_create_memfile(&file, &buffer, &size, 2880, std::realloc, &status);
  long lengths[2] = {16, 8}, tile[2] = {16, 4};
  fits_set_compression_type(file, algorithm, &status);
  fits_set_tile_dim(file, 2, tile, &status);
  fits_create_img(file, type, 2, lengths, &status);
  std::vector<short> values;
  for (int i = 0; i < 128; ++i) values.push_back(static_cast<short>(i * i % 101));
  fits_write_img(file, TSHORT, 1, 128, values.data(), &status);
  fits_flush_file(file, &status);
  LONGLONG header = 0, data = 0, end = 0;
  fits_get_hduaddrll(file, &header, &data, &end, &status);
  std::string bytes;
  if (status == 0) bytes.assign(static_cast<const char*>(buffer), static_cast<std::size_t>(end));
  int ignored = 0;
  fits_close_file(file, &ignored);
  std::free(buffer);
  return bytes;
}

void add_fits(std::vector<std::string>& seeds) {
  seeds.push_back(fits_image(16, {4, 2}, {-32768, -1, 0, 1, 2, 3, 4, 32767},
                             fits_card("BZERO", "32768") + fits_card("BSCALE", "1") +
                                 fits_card("ROWORDER", "'TOP-DOWN'") + fits_card("SATURATE", "60000.")));
  seeds.push_back(fits_image(-32, {2, 2, 3}, std::vector<double>(12, 0.25), fits_card("DATAMAX", "7.")));
  seeds.push_back(fits_image(8, {3, 1}, {1, 2, 3}, fits_card("BLANK", "2")));
  for (const int type : {BYTE_IMG, SHORT_IMG, FLOAT_IMG}) seeds.push_back(packed_fits(RICE_1, type));
  seeds.push_back(packed_fits(GZIP_1, SHORT_IMG));
}

void add_display_files(std::vector<std::string>& seeds) {
  for (const int channels : {1, 3}) {
    const auto names =
        channels == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
    const sim::Image image = gradient(16, 12, names);
    seeds.push_back(sim::encode_display(sim::ImageFormat::jpeg, image, 8, 80, {{"DateTime", "2019-03-01"}}));
    for (const int bits : {8, 16}) {
      seeds.push_back(sim::encode_display(sim::ImageFormat::png, image, bits, 0, {}));
      seeds.push_back(sim::encode_display(sim::ImageFormat::tiff, image, bits, 0, {}));
    }
    seeds.push_back(sim::encode_exr({&image}, {{"units", "of light"}}));
  }
}

std::string exif() {
  using Exif = ExifMaker;
  return Exif(true)
      .text(Exif::kImage, 271, "maker")
      .shorts(Exif::kImage, 274, {6})
      .fractions(Exif::kExif, 33434, {{13, 10}})
      .fractions(Exif::kExif, 37386, {{240, 10}})
      .text(Exif::kExif, 36867, "2019:03:01 00:16:30")
      .text(Exif::kExif, 36881, "-07:00")
      .text(Exif::kGps, 1, "N")
      .fractions(Exif::kGps, 2, {{62, 1}, {27, 1}, {10, 1}})
      .bytes();
}

}  // namespace

std::vector<std::string> fuzz_seeds(const std::string& source) {
  std::vector<std::string> seeds;
  const std::string jpeg = jpeg_of_blocks(2, 1, {50, 200});
  seeds.push_back(jpeg);
  seeds.push_back(with_app1(jpeg, std::string("Exif\0\0", 6) + exif()));
  seeds.push_back(png(2, 2, 3, 8, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, png_chunk("eXIf", exif())));
  seeds.push_back(png(2, 1, 4, 16, {1, 2, 3, 65535, 5, 6, 7, 8}));
  Tiff plain;
  plain.width = 2, plain.height = 1;
  seeds.push_back(tiff(plain, {1, 2, 3, 4, 5, 6}));
  plain.floating = true, plain.bits = 32;
  seeds.push_back(tiff(plain, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}));
  Dng small;
  std::vector<int> sites;
  for (int i = 0; i < small.width * small.height; ++i) sites.push_back(37 * i % 65536);
  seeds.push_back(dng(small, sites));
  seeds.push_back("P5\n# a remark\n2 1\n255\nab");
  seeds.push_back("P6 1 1 65535\nabcdef");
  seeds.push_back("P3\n1 2 1000\n0 500 1000 # half\n1 2 3\n");
  std::string keo = "$Spextube IV image file generation -1";
  keo.resize(60, '\0');
  seeds.push_back(keo + std::string("\2\0\1\0\2\0", 6) + "abcd");
  const std::string frames = frames_bytes();
  seeds.push_back(frames);
  seeds.push_back(gzip_stored(frames));
  seeds.push_back(gzip_stored("P6 1 1 255\nabc") + gzip_stored("P6 1 1 255\ndef"));
  // "P5 1 1 255\na" twice, packed: the second time is told as bytes of before.
  seeds.emplace_back(
      "\037\213\010\000\000\000\000\000\002\003\013\060\125\060\004\102\043\123\123\256\304\000\044\066\000"
      "\137\066\265\211\030\000\000\000",
      33);
  add_fits(seeds);
  add_display_files(seeds);
  for (const char* name : {"/tests/data/quarters.heic", "/tests/data/turned.heic"}) {
    std::ifstream stream(source + name, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return seeds;
}

std::vector<std::string> fuzz_dictionary() {
  std::vector<std::string> words = {
      "\xff\xd8",   "\xff\xd9", "\xff\xda",    "\xff\xc0", "\xff\xc2", "\xff\xdd", "IHDR",
      "IDAT",       "PLTE",     "tRNS",        "eXIf",     "ispe",     "iloc",     "iinf",
      "infe",       "Exif",     "irot",        "grid",     "hvcC",     "meta",     "mdat",
      "dataWindow", "chlist",   "compression", "tiles",    "box2i",    "II\x2a",   "FUJIFILMCCD-RAW",
      "IIRO",       "ftypcrx ", "ftypheic",    "ftypmif1"};
  for (const char* word : {"\x1f\x8b\x08", "#\"Image request start\" 2014-03-10 06:03:59.5 UTC\n",
                           "#\"Exposure options\" WIDTH=", "XBIN=0 ", "MSEC=-1 "})
    words.emplace_back(word);
  for (const char* key :
       {"BITPIX", "NAXIS", "NAXIS1", "NAXIS2", "NAXIS3", "BZERO", "BSCALE", "BLANK", "ZIMAGE", "ZTILE1",
        "ZNAXIS1", "ZBITPIX", "TFIELDS", "PCOUNT", "GCOUNT", "SATURATE", "DATAMAX"})
    for (const char* value : {"-64", "0", "8", "64", "40000", "1E308", "-1"})
      words.push_back(fits_card(key, value));
  for (const int tag :
       {254, 256, 257, 258, 259, 262, 273, 274,   277,   278,   279,   284,   317,   320,   322,
        323, 324, 325, 330, 338, 339, 530, 33421, 33422, 34665, 34853, 37386, 50706, 50714, 50717})
    for (const int type : {3, 4}) {
      words.push_back(little_endian(tag, 2) + little_endian(type, 2) + little_endian(1, 4));
      words.push_back(big_endian(tag, 2) + big_endian(type, 2) + big_endian(1, 4));
    }
  return words;
}

void mend_after_mutation(std::string& input) {
  if (input.compare(0, 4, "\x89PNG") != 0) return;
  for (std::size_t at = 8; at + 12 <= input.size();) {
    std::size_t length = 0;
    for (int i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(input[at + i]);
    if (length > input.size() - at - 12) return;
    const std::string chunk = png_chunk(input.substr(at + 4, 4), input.substr(at + 8, length));
    input.replace(at + 8 + length, 4, chunk.substr(chunk.size() - 4));
    at += 12 + length;
  }
}

}  // namespace vegard::tests
