#include "sim/base/picture/png_pixels.h"

#include <png.h>

#include <csetjmp>
#include <cstddef>
#include <cstring>

namespace vegard::sim {
namespace {

struct PngSource {
  const char* at;
  std::size_t left;
};

void take_bytes(png_structp png, png_bytep to, std::size_t size) {
  auto& from = *static_cast<PngSource*>(png_get_io_ptr(png));
  if (size > from.left) png_error(png, "the end");
  std::memcpy(to, from.at, size);
  from.at += size;
  from.left -= size;
}

[[noreturn]] void give_up_reading(png_structp png, png_const_charp) { png_longjmp(png, 1); }

void pass_over_warning(png_structp, png_const_charp) {}

struct PngWish {
  png_uint_32 width, height;
  int bits;
  unsigned char* to;
};

/// Nothing in here needs a destructor: the library leaves it by longjmp() where it gives up.
bool read_rows(png_structp png, png_infop info, const PngWish& wish) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_info(png, info);
  const int colour = png_get_color_type(png, info);
  const bool is_common = (colour == PNG_COLOR_TYPE_GRAY || colour == PNG_COLOR_TYPE_RGB) &&
                         png_get_valid(png, info, PNG_INFO_tRNS) == 0 &&
                         png_get_interlace_type(png, info) == PNG_INTERLACE_NONE &&
                         png_get_bit_depth(png, info) == wish.bits;
  if (!is_common || png_get_image_width(png, info) != wish.width ||
      png_get_image_height(png, info) != wish.height)
    return false;
  if (wish.bits == 16) png_set_swap(png);
  if (colour == PNG_COLOR_TYPE_GRAY) png_set_gray_to_rgb(png);
  png_set_bgr(png);
  png_read_update_info(png, info);
  const std::size_t row_bytes = png_get_rowbytes(png, info);
  if (row_bytes != static_cast<std::size_t>(wish.width) * 3 * (wish.bits / 8)) return false;
  for (png_uint_32 y = 0; y < wish.height; ++y) png_read_row(png, wish.to + y * row_bytes, nullptr);
  png_read_end(png, nullptr);
  return true;
}

}  // namespace

bool read_png_pixels(std::string_view bytes, int width, int height, int bits, void* to) {
  if (bits != 8 && bits != 16) return false;
  PngSource from{bytes.data(), bytes.size()};
  png_structp png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, give_up_reading, pass_over_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  bool good = false;
  if (info != nullptr) {
    png_set_read_fn(png, &from, take_bytes);
    good = read_rows(png, info,
                     {static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), bits,
                      static_cast<unsigned char*>(to)});
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return good;
}

}  // namespace vegard::sim
