#include "fit/photo/codec/image_walk.h"
#include "fit/photo/codec/picture_codes.h"
#include "sim/base/picture/heif.h"

namespace vegard::fit {

PictureCodes decode_heif(std::string_view bytes, const std::string& file) {
  const sim::CodedPicture picture = sim::read_heif(bytes, file);
  if (!heif_promises(bytes, picture.width, picture.height, file))
    refuse_image(file, "the image decodes to something else than its header promises", "",
                 "open it in an image viewer and save it anew");
  PictureCodes codes;
  codes.width = picture.width;
  codes.height = picture.height;
  codes.values.assign(picture.codes.begin(), picture.codes.end());
  codes.kind = "8-bit HEIC by " + picture.library;
  return codes;
}

}  // namespace vegard::fit
