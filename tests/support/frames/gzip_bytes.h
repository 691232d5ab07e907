// gzip files (RFC 1952) written without zlib: their bytes are stored, not packed (RFC 1951, 3.2.4), so that a
// test knows where each of them stands.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

namespace vegard::tests {

inline std::string low_byte_first(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

/// Bit by bit, as RFC 1952, section 8, defines it.
inline std::uint32_t crc_of(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
  }
  return crc ^ 0xffffffffu;
}

inline std::string gzip_stored(const std::string& bytes) {
  constexpr std::size_t kMaxInBlock = 65535, kHeader = 10;
  std::string file("\x1f\x8b\x08\0\0\0\0\0\0\xff", kHeader);
  std::size_t at = 0;
  do {
    const std::size_t count = std::min(kMaxInBlock, bytes.size() - at);
    file += at + count == bytes.size() ? '\1' : '\0';
    file += low_byte_first(static_cast<std::uint32_t>(count), 2) +
            low_byte_first(~static_cast<std::uint32_t>(count), 2) + bytes.substr(at, count);
    at += count;
  } while (at < bytes.size());
  return file + low_byte_first(crc_of(bytes), 4) +
         low_byte_first(static_cast<std::uint32_t>(bytes.size()), 4);
}

}  // namespace vegard::tests
