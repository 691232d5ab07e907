#include "sim/base/picture/exif_block.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "sim/base/file/byte_stream.h"
#include "sim/base/picture/heif_boxes.h"
#include "sim/base/picture/tiff_directory.h"

namespace vegard::sim {
namespace {

using namespace std::string_view_literals;

constexpr auto kPngStart = "\x89PNG\r\n\x1a\n"sv;
constexpr auto kFujiStart = "FUJIFILMCCD-RAW"sv;
constexpr auto kExifStart = "Exif\0\0"sv;

std::optional<std::pair<int, int>> size_of(std::uint64_t width, std::uint64_t height) {
  constexpr std::uint64_t kMax = 1u << 30;
  if (width == 0 || height == 0 || width > kMax || height > kMax) return std::nullopt;
  return std::pair<int, int>(width, height);
}

bool is_start_of_frame(int marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

/// The segments before the first scan.
ExifBlock in_jpeg(std::string_view bytes) {
  ExifBlock block;
  std::size_t at = 2;
  while (at + 4 <= bytes.size()) {
    if (bytes[at] != '\xff') {
      ++at;  // as decoders do with bytes that belong to nothing
      continue;
    }
    const int marker = static_cast<unsigned char>(bytes[at + 1]);
    if (marker == 0xff || marker == 0x00 || marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8)) {
      at += marker == 0xff ? 1 : 2;
      continue;
    }
    if (marker == 0xd9 || marker == 0xda) break;
    const std::size_t length = unsigned_at(bytes, at + 2, 2);
    if (length < 2) break;
    const std::string_view body = bytes.substr(at + 4, length - 2);
    if (marker == 0xe1 && block.tiff.empty() && body.substr(0, 6) == kExifStart) block.tiff = body.substr(6);
    if (is_start_of_frame(marker) && body.size() >= 5)
      block.size_px = size_of(unsigned_at(body, 3, 2), unsigned_at(body, 1, 2));
    at += 2 + length;
  }
  return block;
}

ExifBlock in_png(std::string_view bytes) {
  ExifBlock block;
  std::size_t at = kPngStart.size();
  while (at + 8 <= bytes.size()) {
    const std::size_t length = unsigned_at(bytes, at, 4);
    const std::string_view type = bytes.substr(at + 4, 4), body = bytes.substr(at + 8, length);
    if (type == "IHDR"sv && body.size() >= 8)
      block.size_px = size_of(unsigned_at(body, 0, 4), unsigned_at(body, 4, 4));
    if (type == "eXIf"sv && block.tiff.empty())
      block.tiff = body.substr(0, 6) == kExifStart ? body.substr(6) : body;
    if (type == "IEND"sv || length > bytes.size() - at - 8) break;
    at += 12 + length;
  }
  return block;
}

/// Raw files keep a small picture in the first directory, and the large one elsewhere: their size is known
/// only to who decodes them.
ExifBlock in_tiff(std::string_view bytes) {
  using namespace tiff_tag;
  ExifBlock block;
  const auto directory = TiffDirectory::first(bytes);
  if (!directory) return block;
  block.tiff = bytes;
  const bool plain = bytes[2] == '\x2a' || bytes[3] == '\x2a';
  const bool canon_raw = bytes.substr(8, 2) == "CR"sv;
  if (!plain || canon_raw || directory->has(kSubDirectories) || directory->has(kDngVersion) ||
      directory->number(kSubfileType).value_or(0.0) != 0.0)
    return block;
  const auto width = directory->number(kWidth), height = directory->number(kHeight);
  constexpr double kMax = 1 << 30;
  if (width && height && *width >= 1.0 && *height >= 1.0 && *width <= kMax && *height <= kMax)
    block.size_px = std::pair<int, int>(static_cast<int>(*width), static_cast<int>(*height));
  return block;
}

/// Fujifilm's raw files carry a JPEG with the EXIF data; where, stands in their header.
ExifBlock in_fuji(std::string_view bytes) {
  if (bytes.size() < 92) return {};
  const std::size_t at = unsigned_at(bytes, 84, 4), length = unsigned_at(bytes, 88, 4);
  if (at >= bytes.size()) return {};
  ExifBlock block = in_jpeg(bytes.substr(at, length));
  block.size_px.reset();
  return block;
}

bool is_heif(std::string_view bytes) { return bytes.substr(4, 4) == "ftyp"sv; }

}  // namespace

bool may_have_exif(std::string_view bytes) {
  if (bytes.size() < 12) return false;
  return bytes.substr(0, 2) == "\xff\xd8"sv || bytes.substr(0, 8) == kPngStart ||
         bytes.substr(0, kFujiStart.size()) == kFujiStart || is_heif(bytes) ||
         TiffDirectory::first(bytes).has_value();
}

ExifBlock find_exif_block(std::string_view bytes) {
  if (!may_have_exif(bytes)) return {};
  if (bytes.substr(0, 2) == "\xff\xd8"sv) return in_jpeg(bytes);
  if (bytes.substr(0, 8) == kPngStart) return in_png(bytes);
  if (bytes.substr(0, kFujiStart.size()) == kFujiStart) return in_fuji(bytes);
  if (is_heif(bytes)) return {heif_exif(bytes), std::nullopt, false};
  return in_tiff(bytes);
}

}  // namespace vegard::sim
