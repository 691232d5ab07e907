#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <utility>

#include "sim/base/picture/image_io/library.h"
#include "sim/base/picture/png_pixels.h"

namespace vegard::sim {
namespace {

/// What is written so far, and what the library says when it gives up.
struct PngBytes {
  std::string bytes, complaint;
};

void append(png_structp png, png_bytep data, std::size_t size) {
  static_cast<PngBytes*>(png_get_io_ptr(png))->bytes.append(reinterpret_cast<const char*>(data), size);
}

[[noreturn]] void give_up(png_structp png, png_const_charp words) {
  static_cast<PngBytes*>(png_get_error_ptr(png))->complaint = words;
  png_longjmp(png, 1);
}

void pass_over(png_structp, png_const_charp) {}

/// How rows are filtered and compressed: of png_set_filter(), and zlib's level and strategy.
struct PngPacking {
  int filters, level, strategy;
};
constexpr int kZlibsOwn = 0, kZlibsRuns = 3;  // Z_DEFAULT_STRATEGY, Z_RLE

/// Everything that needs no destructor: the library leaves it by longjmp() where it gives up.
struct PngContent {
  PngPacking packing;
  png_uint_32 width, height;
  int bits, colour_type;
  bool is_blue_first;
  bool is_display;  ///< that it is sRGB, and where it begins, is written too
  std::size_t row_bytes;
  const unsigned char* pixels;
  const png_time* time;  ///< null: none
  const png_text* texts;
  int text_count;
};

/// False if the library gives up.
bool put(png_structp png, png_infop info, const PngContent& content) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_compression_level(png, content.packing.level);
  png_set_compression_strategy(png, content.packing.strategy);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, content.packing.filters);
  png_set_IHDR(png, info, content.width, content.height, content.bits, content.colour_type,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (content.is_display) {
    png_set_oFFs(png, info, 0, 0, PNG_OFFSET_PIXEL);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
  }
  if (content.time != nullptr) png_set_tIME(png, info, content.time);
  png_set_text(png, info, content.texts, content.text_count);
  png_write_info(png, info);
  if (content.bits == 16) png_set_swap(png);  // big-endian in the file
  if (content.is_blue_first) png_set_bgr(png);
  for (png_uint_32 y = 0; y < content.height; ++y) png_write_row(png, content.pixels + y * content.row_bytes);
  png_write_end(png, nullptr);
  return true;
}

bool time_of(const std::string& exif, png_time& time) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
  if (std::sscanf(exif.c_str(), "%4d:%2d:%2d %2d:%2d:%2d", &year, &month, &day, &hour, &minute, &second) != 6)
    return false;
  const auto byte = [](int number) { return static_cast<png_byte>(number); };
  time = {static_cast<png_uint_16>(year), byte(month), byte(day), byte(hour), byte(minute), byte(second)};
  return true;
}

/// Throws Error(unwritable_output) about the file `name`.
std::string written(const PngContent& content, const std::string& name) {
  PngBytes to;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &to, give_up, pass_over);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  bool good = info != nullptr;
  if (good) {
    png_set_write_fn(png, &to, append, nullptr);
    good = put(png, info, content);
  }
  png_destroy_write_struct(&png, &info);
  if (!good) throw failure(ErrorKind::unwritable_output, name, "cannot be encoded: " + to.complaint);
  return std::move(to.bytes);
}

}  // namespace

std::string encode_png(const PictureLayout& layout, int bits, const ImageAttributes& attributes,
                       const void* pixels, const std::string& name) {
  std::vector<std::pair<std::string, std::string>> words = {{"oiio:ColorSpace", "sRGB"}};
  for (const auto& [key, value] : attributes) {
    if (key == "DateTime" || value.empty()) continue;
    words.emplace_back(key == "ImageDescription" ? "Description" : own_prefix + key, value);
  }
  std::vector<png_text> texts;
  for (auto& [key, value] : words) {
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = key.data();
    text.text = value.data();
    text.text_length = value.size();
    texts.push_back(text);
  }
  png_time time{};
  const bool is_timed = time_of(exif_time(value_or_empty(attributes, "DateTime")), time);
  PngContent content{};
  content.packing = {PNG_NO_FILTERS, 6, kZlibsOwn};
  content.is_display = true;
  content.width = static_cast<png_uint_32>(layout.width);
  content.height = static_cast<png_uint_32>(layout.height);
  content.bits = bits;
  content.colour_type = layout.channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB;
  content.row_bytes = static_cast<std::size_t>(layout.width) * layout.channels * (bits / 8);
  content.pixels = static_cast<const unsigned char*>(pixels);
  content.time = is_timed ? &time : nullptr;
  content.texts = texts.data();
  content.text_count = static_cast<int>(texts.size());

  return written(content, name);
}

std::string encode_plain_png(const unsigned char* pixels, int width, int height, int channels,
                             std::size_t row_bytes, int level) {
  PngContent content{};
  content.packing =
      level == 0 ? PngPacking{PNG_FILTER_SUB, 1, kZlibsRuns} : PngPacking{PNG_ALL_FILTERS, level, kZlibsOwn};
  content.width = static_cast<png_uint_32>(width);
  content.height = static_cast<png_uint_32>(height);
  content.bits = 8;
  content.colour_type = channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB;
  content.is_blue_first = true;
  content.row_bytes = row_bytes;
  content.pixels = pixels;
  return written(content, "picture.png");
}

}  // namespace vegard::sim
