#include "sim/base/picture/whole_picture.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace vegard::sim {
namespace {

std::uint32_t byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  return byte_at(bytes, at) << 24 | byte_at(bytes, at + 1) << 16 | byte_at(bytes, at + 2) << 8 |
         byte_at(bytes, at + 3);
}

/// CRC-32 as PNG has it (annex D).
std::uint32_t checksum(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t n = 0; n < 256; ++n) {
      t[n] = n;
      for (int k = 0; k < 8; ++k) t[n] = (t[n] & 1u) != 0 ? 0xEDB88320u ^ (t[n] >> 1) : t[n] >> 1;
    }
    return t;
  }();
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const char c : bytes) crc = table[(crc ^ static_cast<unsigned char>(c)) & 0xFFu] ^ (crc >> 8);
  return ~crc;
}

}  // namespace

bool png_is_whole(std::string_view bytes) {
  constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
  if (bytes.substr(0, kSignature.size()) != kSignature) return false;
  std::size_t at = kSignature.size();
  while (bytes.size() - at >= 12) {
    const std::size_t length = word_at(bytes, at);
    if (length > bytes.size() - at - 12) return false;
    const std::string_view name_and_data = bytes.substr(at + 4, 4 + length);
    if (checksum(name_and_data) != word_at(bytes, at + 8 + length)) return false;
    if (name_and_data.substr(0, 4) == "IEND") return true;
    at += 12 + length;
  }
  return false;
}

bool jpeg_is_whole(std::string_view bytes) {
  constexpr std::uint32_t kStart = 0xD8, kEnd = 0xD9, kScan = 0xDA, kFirstRestart = 0xD0;
  if (bytes.size() < 2 || byte_at(bytes, 0) != 0xFF || byte_at(bytes, 1) != kStart) return false;
  std::size_t at = 2;
  bool in_scan = false;
  while (at + 1 < bytes.size()) {
    const std::uint32_t marker = byte_at(bytes, at + 1);
    if (byte_at(bytes, at) != 0xFF || (in_scan && marker == 0)) {
      if (!in_scan) return false;
      ++at;
    } else if (marker == 0xFF) {
      ++at;  // any number of these may stand before a marker
    } else if (marker >= kFirstRestart && marker < kStart) {
      at += 2;
    } else if (marker == kEnd) {
      return true;
    } else {
      if (at + 3 >= bytes.size()) return false;
      in_scan = marker == kScan;
      at += 2 + (byte_at(bytes, at + 2) << 8 | byte_at(bytes, at + 3));
    }
  }
  return false;
}

}  // namespace vegard::sim
