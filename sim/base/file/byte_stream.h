// Reads the bytes of a file, or bytes in memory: in any order, or sequentially with a buffer of fixed size,
// where gzip data (RFC 1952) are unpacked. Only byte_stream.cpp includes zlib.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace vegard::sim {

/// Returns the unsigned integer of `size` bytes at `at`, which must lie inside of `bytes`.
inline std::uint64_t unsigned_at(std::string_view bytes, std::size_t at, std::size_t size,
                                 bool big_endian = true) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + (big_endian ? i : size - 1 - i)]);
  return value;
}

/// Random access to bytes.
class RandomBytes {
 public:
  /// Opens the file `name`; or `bytes`, if given, which must outlive the object, with `name` for messages.
  /// Throws Error(unreadable_input) if the file is not a regular file or cannot be opened.
  explicit RandomBytes(std::string name, std::string_view bytes = {});
  ~RandomBytes();
  RandomBytes(const RandomBytes&) = delete;
  RandomBytes& operator=(const RandomBytes&) = delete;

  const std::string& name() const { return name_; }
  std::uint64_t size() const { return size_; }
  /// Reads `count` bytes from `place` on, or as many as there are; returns their number.
  std::size_t read(std::uint64_t place, char* to, std::size_t count) const;
  /// Returns `count` bytes from `place` on. Throws Error(unreadable_input), before allocating memory, if they
  /// are not all in the file.
  std::string bytes(std::uint64_t place, std::uint64_t count) const;

 private:
  std::string name_;
  std::string_view bytes_;
  std::size_t size_ = 0;
  int descriptor_ = -1;
};

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

/// Returns bytes as gzip data, the same for the same bytes.
std::string gzipped(std::string_view bytes);

}  // namespace vegard::sim
