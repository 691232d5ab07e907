// Random access to the bytes of a file, or to bytes in memory, and the integers in them.
#pragma once

#include <cstddef>
#include <cstdint>
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

}  // namespace vegard::sim
