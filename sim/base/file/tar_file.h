// The files in a tar (POSIX ustar, pax, GNU), by libarchive, which is compiled in tar_file.cpp alone. Nothing
// is written to disk, and links are not followed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vegard::sim {

struct TarEntry {
  std::string name;          ///< with its folders
  std::uint64_t offset = 0;  ///< of its header in the tar
  std::uint64_t bytes = 0;
};

/// Whether a file begins as a tar does.
bool is_tar(std::string_view beginning);

/// The tar itself is not compressed, so that an entry is found without reading those before it. All throws
/// Error(unreadable_input), naming the file, for a tar that is damaged or cut short, or holds more than the
/// limits here.
class TarFile {
 public:
  static constexpr std::size_t kMaxEntries = 200000;
  static constexpr std::uint64_t kMaxEntryBytes = std::uint64_t{1} << 28;

  /// Of a file, or of bytes that outlive it (`name` is for messages then). Its headers are gone through.
  explicit TarFile(std::string name, std::string_view bytes = {});

  /// The regular files in it, in its order.
  const std::vector<TarEntry>& entries() const { return entries_; }
  std::string read(const TarEntry& entry) const;

 private:
  std::string name_;
  std::string_view bytes_;
  std::vector<TarEntry> entries_;
};

}  // namespace vegard::sim
