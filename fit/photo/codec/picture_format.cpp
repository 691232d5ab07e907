#include "fit/photo/codec/picture_format.h"

#include <algorithm>
#include <new>

#include "fit/photo/codec/declaration_reader.h"
#include "sim/base/error.h"
#include "sim/base/picture/pixel_limit.h"
#include "sim/base/quiet_decoder.h"
#include "sim/base/text.h"

namespace vegard::fit {
namespace {

std::string known_formats() {
  std::vector<std::string> names;
  for (const PictureFormat& format : picture_formats()) names.emplace_back(format.name);
  return sim::joined(names, ", ", " or ");
}

bool begins_as(const PictureFormat& format, std::string_view bytes) {
  return std::any_of(format.beginnings.begin(), format.beginnings.end(),
                     [&](std::string_view start) { return sim::starts_with(bytes, start); });
}

}  // namespace

ImageFile inspect_image_file(std::string_view bytes, const std::string& file) {
  if (bytes.empty())
    throw sim::unreadable(file, "the file is empty").expected(known_formats()).hint(sim::kCopyAgain);
  for (const PictureFormat& format : picture_formats()) {
    if (!format.beginnings.empty() && !begins_as(format, bytes)) continue;
    if (format.is_format != nullptr && !format.is_format(bytes)) continue;
    ImageFile image = format.walk(bytes, file);
    image.format = &format;
    if (format.walk != walk_camera_raw) image.declared = declared_light(bytes);
    // The library that decodes FITS and raw files tells their size, and checks it.
    const bool size_is_known = image.width != 0 || image.height != 0;
    if (size_is_known || !image.size_comes_later) sim::check_pixel_limit(image.width, image.height, file);
    return image;
  }
  throw sim::unreadable(file, "this is no image that can be read")
      .expected(known_formats() + ", by its contents and not by its name")
      .hint("convert it to a 16-bit TIFF, unpack it if it is compressed");
}

std::string kind_of_codes(const ImageFile& image) {
  return std::to_string(image.bits) + (image.floating ? "-bit float " : "-bit ") + image.format->name;
}

PictureCodes picture_codes(std::string_view bytes, const std::string& file) {
  const ImageFile image = inspect_image_file(bytes, file);
  const sim::QuietDecoder quiet;
  try {
    PictureCodes codes = image.format->decode(bytes, image, file);
    codes.block_error = image.block_error;
    codes.declared = image.declared;
    return codes;
  } catch (const std::bad_alloc&) {
    throw sim::unreadable(file, "there is not enough memory for this image").hint("scale or crop it first");
  }
}

}  // namespace vegard::fit
