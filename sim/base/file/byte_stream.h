// ByteStream: reads the bytes of a file sequentially with a buffer of fixed size, and unpacks gzip data (RFC
// 1952). Only byte_stream.cpp includes zlib.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace vegard::sim {

/// Largest count of look().
constexpr std::size_t kMaxPeekBytes = 1 << 16;
/// Largest unpacked size: a few packed kilobytes can unpack to any number of bytes.
constexpr std::uint64_t kMaxUnpackedBytes = std::uint64_t{1} << 34;

/// All reading functions throw Error(unreadable_input), naming the file, for gzip data that are damaged (by
/// their checksums too), end early, are followed by anything but zeros or another gzip file, or unpack to
/// more than kMaxUnpackedBytes.
class ByteStream {
 public:
  /// Throws Error(unreadable_input) if the file is not a regular file or cannot be opened.
  explicit ByteStream(const std::string& path);
  /// Reads from bytes, which must outlive the stream; `name` is for messages.
  ByteStream(std::string_view bytes, const std::string& name);
  /// Reads from zlib data (RFC 1950), which must outlive the stream; bytes after their end are ignored.
  static ByteStream of_zlib(std::string_view bytes, const std::string& name);
  ~ByteStream();
  ByteStream(ByteStream&&) noexcept;
  ByteStream& operator=(ByteStream&&) noexcept;

  bool is_packed() const;
  /// Returns the number of unpacked bytes that have been read or skipped.
  std::uint64_t position() const;

  /// Returns the next `count` bytes, at most kMaxPeekBytes, or as many as there are, without consuming them.
  /// Valid until the next call of a member function.
  std::string_view look(std::size_t count);
  /// Reads `count` bytes to `to`, or as many as there are; returns their number. The checksums of gzip are
  /// only checked when the end of the data has been read or looked at.
  std::size_t read(char* to, std::size_t count);
  /// Skips `count` bytes, or as many as there are; returns their number. Unpacked files are not read for it.
  std::uint64_t skip(std::uint64_t count);

 private:
  struct Source;
  explicit ByteStream(std::unique_ptr<Source> source);
  std::unique_ptr<Source> source_;
};

/// True if the first bytes are those of gzip data.
bool is_gzip(std::string_view bytes);

}  // namespace vegard::sim
