#include "fit/photo/codec/image_walk.h"

#include "sim/base/picture/pixel_limit.h"

namespace vegard::fit {
namespace {

constexpr const char* known_formats = "JPEG, PNG, TIFF, EXR, FITS, PGM, PPM, camera raw or HEIC";

}  // namespace

ImageFile inspect_image_file(std::string_view bytes, const std::string& file) {
  if (bytes.empty())
    refuse_image(file, "the file is empty", known_formats, "copy it again from where it came");
  ImageFile image;
  using namespace std::string_view_literals;
  if (starts_with(bytes, "\xff\xd8"sv)) {
    image = walk_jpeg(bytes, file);
  } else if (starts_with(bytes, "\x89PNG\r\n\x1a\n"sv)) {
    image = walk_png(bytes, file);
  } else if (is_camera_raw(bytes)) {
    image = walk_camera_raw(bytes, file);
  } else if (starts_with(bytes, "II\x2a\0"sv) || starts_with(bytes, "MM\0\x2a"sv) ||
             starts_with(bytes, "II\x2b\0"sv) || starts_with(bytes, "MM\0\x2b"sv)) {
    image = walk_tiff(bytes, file);
  } else if (starts_with(bytes, "P2"sv) || starts_with(bytes, "P3"sv) || starts_with(bytes, "P5"sv) ||
             starts_with(bytes, "P6"sv)) {
    image = walk_pnm(bytes, file);
  } else if (starts_with(bytes, "v/1\x01"sv)) {
    image = walk_exr(bytes, file);
  } else if (is_heif(bytes)) {
    image = walk_heif(bytes, file);
  } else if (starts_with(bytes, "SIMPLE  ="sv)) {
    image.format = ImageFormat::fits;
  } else {
    refuse_image(file, "this is no image that can be read",
                 std::string(known_formats) + ", by its contents and not by its name",
                 "convert it to a 16-bit TIFF, unpack it if it is compressed");
  }
  const bool size_is_known = image.width != 0 || image.height != 0;
  const bool size_comes_later = image.format == ImageFormat::fits || image.format == ImageFormat::raw;
  if (size_is_known || !size_comes_later) sim::check_pixel_limit(image.width, image.height, file);
  return image;
}

}  // namespace vegard::fit
