#include "fit/photo/codec/image_walk.h"
#include "fit/photo/codec/picture_codes.h"
#include "fit/photo/codec/pnm_header.h"

namespace vegard::fit {

PictureCodes decode_pnm(std::string_view bytes, const ImageFile& image, const std::string& file) {
  const PnmHeader header = pnm_header(bytes, file);
  PictureCodes codes;
  codes.width = static_cast<int>(header.width);
  codes.height = static_cast<int>(header.height);
  codes.channels = header.channels;
  codes.white = header.largest;
  codes.bits = image.bits;
  // Above eight bits it is scientific cameras that write these files, and they write what they count.
  codes.linear = header.largest > 255;
  codes.kind = std::to_string(image.bits) + "-bit " + format_name(image.format);
  codes.values.resize(static_cast<std::size_t>(codes.width) * codes.height * codes.channels);
  const int size = header.largest > 255 ? 2 : 1;
  std::size_t at = header.data;
  for (float& value : codes.values) {
    long long number = 0;
    if (header.in_words) {
      number = next_pnm_number(bytes, at);
      if (number < 0 && at >= bytes.size()) throw_truncated(file, "it ends before its last pixel");
      if (number < 0) throw_damaged(file, "there is something else than numbers among its pixels");
    } else {
      number = static_cast<long long>(unsigned_at(bytes, at, size, true));
      at += size;
    }
    if (number > header.largest)
      throw_damaged(file, "a pixel is " + std::to_string(number) + ", above the header's largest value " +
                              std::to_string(header.largest));
    value = static_cast<float>(number);
  }
  return codes;
}

}  // namespace vegard::fit
