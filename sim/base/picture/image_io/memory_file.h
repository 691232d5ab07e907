// Bytes in memory with a file name, for decoders that only open files by name.
#pragma once

#include <string>
#include <string_view>

namespace vegard::sim {

/// A file in memory, in no folder, that exists as long as this object. Linux only (memfd_create, /proc).
class MemoryFile {
 public:
  /// Throws Error(unreadable_input) about the file `name` if there is no memory for it.
  MemoryFile(std::string_view bytes, const std::string& name);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const;

 private:
  int descriptor_ = -1;
};

}  // namespace vegard::sim
