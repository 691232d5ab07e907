#include "fit/photo/codec/picture_codes.h"

#include <new>

#include "fit/photo/codec/image_walk.h"
#include "sim/base/quiet_decoder.h"

namespace vegard::fit {
namespace {

PictureCodes decoded(std::string_view bytes, const ImageFile& image, const std::string& file) {
  switch (image.format) {
    case ImageFormat::jpeg:
    case ImageFormat::png:
    case ImageFormat::tiff:
      return decode_by_opencv(bytes, image, file);
    case ImageFormat::pgm:
    case ImageFormat::ppm:
      return decode_pnm(bytes, image, file);
    case ImageFormat::exr:
      return decode_exr(bytes, file);
    case ImageFormat::fits:
      return decode_fits(bytes, file);
    case ImageFormat::raw:
      return decode_camera_raw(bytes, file);
    case ImageFormat::heif:
      return decode_heif(bytes, file);
  }
  return {};
}

}  // namespace

PictureCodes picture_codes(std::string_view bytes, const std::string& file) {
  const ImageFile image = inspect_image_file(bytes, file);
  const sim::QuietDecoder quiet;
  try {
    PictureCodes codes = decoded(bytes, image, file);
    codes.block_error = image.block_error;
    return codes;
  } catch (const std::bad_alloc&) {
    refuse_image(file, "there is not enough memory for this image", "", "scale or crop it first");
  }
}

}  // namespace vegard::fit
