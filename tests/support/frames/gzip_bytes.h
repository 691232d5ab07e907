// gzip files (RFC 1952) written without zlib: their bytes are stored, not packed (RFC 1951, 3.2.4), so that a
// test knows where each of them stands.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace vegard::tests {

inline std::string low_byte_first(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

/// By the table of RFC 1952, section 8.
inline std::uint32_t crc_of(const std::string& bytes) {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    table[byte] = byte;
    for (int bit = 0; bit < 8; ++bit)
      table[byte] = (table[byte] & 1) != 0 ? table[byte] >> 1 ^ 0xedb88320u : table[byte] >> 1;
  }
  std::uint32_t crc = 0xffffffffu;
  for (const char byte : bytes) crc = table[(crc ^ static_cast<unsigned char>(byte)) & 0xff] ^ crc >> 8;
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
