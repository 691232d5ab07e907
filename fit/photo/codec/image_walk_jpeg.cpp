#include "fit/photo/codec/image_walk.h"

namespace vegard::fit {
namespace {

// ITU-T T.81, table B.1.
constexpr int kStartOfImage = 0xd8, kEndOfImage = 0xd9, kStartOfScan = 0xda, kApp1 = 0xe1, kTemporary = 0x01;

bool is_restart(int marker) { return marker >= 0xd0 && marker <= 0xd7; }

/// SOF0 to SOF15 without DHT, JPG and DAC, which lie between them.
bool is_start_of_frame(int marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

}  // namespace

ImageFile walk_jpeg(std::string_view bytes, const std::string& file) {
  ImageFile image;
  image.format = ImageFormat::jpeg;
  bool frame_seen = false, scan_seen = false, exif_seen = false;
  std::size_t at = 2;
  while (true) {
    // To the next marker. Inside a scan 0xff is followed by a stuffed zero or a restart marker; bytes that
    // belong to nothing are skipped, as libjpeg does.
    while (at + 1 < bytes.size()) {
      const int next = static_cast<unsigned char>(bytes[at + 1]);
      if (bytes[at] == '\xff' && next != 0 && next != 0xff && !is_restart(next)) break;
      ++at;
    }
    if (at + 1 >= bytes.size())
      throw_truncated(file,
                      scan_seen ? "the JPEG end-of-image marker is missing" : "it ends before the picture");
    const int marker = static_cast<unsigned char>(bytes[at + 1]);
    at += 2;
    if (marker == kEndOfImage) break;
    if (marker == kTemporary || marker == kStartOfImage) continue;

    if (at + 2 > bytes.size()) throw_truncated(file, "it ends inside a JPEG segment");
    const std::size_t length = unsigned_at(bytes, at, 2, true);
    if (length < 2) throw_damaged(file, "a JPEG segment of impossible length");
    if (at + length > bytes.size()) throw_truncated(file, "it ends inside a JPEG segment");
    const std::string_view segment = bytes.substr(at + 2, length - 2);
    at += length;

    if (marker == kApp1 && !exif_seen && segment.substr(0, 6) == std::string_view("Exif\0\0", 6)) {
      image.orientation = exif_orientation(segment.substr(6));
      exif_seen = true;
    } else if (is_start_of_frame(marker) && segment.size() >= 6) {
      image.bits = static_cast<int>(unsigned_at(segment, 0, 1, true));
      image.height = static_cast<long long>(unsigned_at(segment, 1, 2, true));
      image.width = static_cast<long long>(unsigned_at(segment, 3, 2, true));
      frame_seen = true;
    } else if (marker == kStartOfScan) {
      scan_seen = true;
    }
  }
  if (!frame_seen || !scan_seen) throw_damaged(file, "a JPEG without a picture in it");
  if (image.bits != 8) throw_unsupported(file, "a JPEG of " + std::to_string(image.bits) + " bits");
  return image;
}

}  // namespace vegard::fit
