// A file's bytes one after the other, in room of a fixed size whatever the file's; what gzip has packed (RFC
// 1952) is unpacked on the way. zlib stands behind it, and is included in byte_stream.cpp alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace vegard::sim {

/// What look() shows at most.
constexpr std::size_t kMaxPeekBytes = 1 << 16;
/// No file is unpacked further: a few kilobytes may claim to be any number of bytes.
constexpr std::uint64_t kMaxUnpackedBytes = std::uint64_t{1} << 34;

/// All that reads throws Error(unreadable_input), naming the file, for gzip data that are damaged (their
/// checksums among them), end early, are followed by something else than zeros or another gzip file, or
/// unpack to more than kMaxUnpackedBytes.
class ByteStream {
 public:
  /// Throws Error(unreadable_input) for what is no regular file, or cannot be opened.
  explicit ByteStream(const std::string& path);
  /// Of bytes that outlive it; `name` is for messages.
  ByteStream(std::string_view bytes, const std::string& name);
  /// Of bytes that outlive it, and are packed as zlib has it (RFC 1950); what stands behind them is passed
  /// over.
  static ByteStream of_zlib(std::string_view bytes, const std::string& name);
  ~ByteStream();
  ByteStream(ByteStream&&) noexcept;
  ByteStream& operator=(ByteStream&&) noexcept;

  bool is_packed() const;
  /// How many bytes, unpacked, have been read or skipped.
  std::uint64_t position() const;

  /// The next `count` bytes, at most kMaxPeekBytes, or as many as there are; they are still to be read. Good
  /// until the next call of anything here.
  std::string_view look(std::size_t count);
  /// Reads `count` bytes to `to`, or as many as there are; returns how many. What gzip says of its data is
  /// only checked when their end has been read or looked at.
  std::size_t read(char* to, std::size_t count);
  /// The same without keeping them; what is not packed is passed over without being read.
  std::uint64_t skip(std::uint64_t count);

 private:
  struct Source;
  explicit ByteStream(std::unique_ptr<Source> source);
  std::unique_ptr<Source> source_;
};

/// By their first bytes.
bool is_gzip(std::string_view bytes);

}  // namespace vegard::sim
