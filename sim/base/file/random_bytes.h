// Random access to the bytes of a file, or to bytes in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace vegard::sim {

class RandomBytes {
 public:
  /// Of a file; or of bytes that outlive it if there are any (`name` is for messages then). Throws
  /// Error(unreadable_input) for what is no regular file, or cannot be opened.
  explicit RandomBytes(std::string name, std::string_view bytes = {});
  ~RandomBytes();
  RandomBytes(const RandomBytes&) = delete;
  RandomBytes& operator=(const RandomBytes&) = delete;

  const std::string& name() const { return name_; }
  std::uint64_t size() const { return size_; }
  /// Reads `count` bytes from `place` on, or as many as there are; returns how many.
  std::size_t read(std::uint64_t place, char* to, std::size_t count) const;
  /// All of them. Throws Error(unreadable_input) if they do not lie in the file; room is only made if they
  /// do.
  std::string bytes(std::uint64_t place, std::uint64_t count) const;

 private:
  std::string name_;
  std::string_view bytes_;
  std::size_t size_ = 0;
  int descriptor_ = -1;
};

}  // namespace vegard::sim
