#include "fit/photo/codec/image_walk.h"
#include "fit/photo/codec/pnm_header.h"
#include "sim/base/picture/pixel_limit.h"

namespace vegard::fit {

ImageFile walk_pnm(std::string_view bytes, const std::string& file) {
  const PnmHeader header = pnm_header(bytes, file);
  ImageFile image;
  image.format = header.channels == 3 ? ImageFormat::ppm : ImageFormat::pgm;
  image.width = header.width;
  image.height = header.height;
  image.bits = 1;
  while (header.largest >> image.bits != 0) ++image.bits;
  sim::check_pixel_limit(image.width, image.height, file);
  const auto numbers = static_cast<std::size_t>(image.width * image.height * header.channels);
  // A number in words is a digit and a space at least, the last one without it.
  const std::size_t least = header.in_words ? 2 * numbers - 1 : numbers * (header.largest > 255 ? 2 : 1);
  const std::size_t there = bytes.size() - header.data;
  if (there < least)
    throw_truncated(file, "its header promises " + std::to_string(least) + " bytes of pixels and " +
                              std::to_string(there) + " are there");
  return image;
}

}  // namespace vegard::fit
