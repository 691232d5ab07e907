#include "fit/photo/codec/picture_format.h"
#include "sim/base/picture/whole_picture.h"

namespace vegard::fit {

ImageFile walk_exr(std::string_view bytes, const std::string& file) {
  const sim::ExrSize size = sim::check_exr_header(bytes, bytes.size(), file);
  ImageFile image;
  image.bits = 32;
  image.floating = true;
  image.width = size.width;
  image.height = size.height;
  return image;
}

}  // namespace vegard::fit
