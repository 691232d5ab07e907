#include <array>

#include "fit/photo/codec/image_walk.h"

namespace vegard::fit {
namespace {

// The checksum of PNG chunks (ISO/IEC 15948, annex D), reflected polynomial 0xedb88320.
std::uint32_t crc32(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t n = 0; n < 256; ++n) {
      std::uint32_t c = n;
      for (int k = 0; k < 8; ++k) c = (c & 1) ? 0xedb88320u ^ c >> 1 : c >> 1;
      t[n] = c;
    }
    return t;
  }();
  std::uint32_t crc = 0xffffffffu;
  for (const char byte : bytes) crc = table[(crc ^ static_cast<unsigned char>(byte)) & 0xff] ^ crc >> 8;
  return crc ^ 0xffffffffu;
}

}  // namespace

ImageFile walk_png(std::string_view bytes, const std::string& file) {
  ImageFile image;
  image.format = ImageFormat::png;
  bool first = true, data_seen = false;
  std::size_t at = 8;
  while (true) {
    if (at + 12 > bytes.size()) throw_truncated(file, "the PNG end chunk is missing");
    const std::size_t length = unsigned_at(bytes, at, 4, true);
    if (length > bytes.size() - at - 12) throw_truncated(file, "it ends inside a PNG chunk");
    const std::string_view type = bytes.substr(at + 4, 4);
    const std::string_view data = bytes.substr(at + 8, length);
    const bool critical = type[0] >= 'A' && type[0] <= 'Z';
    // A wrong checksum in an ancillary chunk (lower-case initial) harms no pixel.
    if (critical && crc32(bytes.substr(at + 4, 4 + length)) != unsigned_at(bytes, at + 8 + length, 4, true))
      throw_damaged(file, "the checksum of its PNG chunk " + std::string(type) + " is wrong");
    at += 12 + length;

    if (first) {
      if (type != "IHDR" || length != 13) throw_damaged(file, "a PNG without its header");
      image.width = static_cast<long long>(unsigned_at(data, 0, 4, true));
      image.height = static_cast<long long>(unsigned_at(data, 4, 4, true));
      image.bits = static_cast<int>(unsigned_at(data, 8, 1, true));
      first = false;
    } else if (type == "IDAT") {
      data_seen = true;
    } else if (type == "eXIf") {
      image.orientation = exif_orientation(data);
    } else if (type == "IEND") {
      break;
    }
  }
  if (!data_seen) throw_damaged(file, "a PNG without a picture in it");
  return image;
}

}  // namespace vegard::fit
