// Reads the files in a tar archive (POSIX ustar, pax, GNU) with libarchive, which only tar_file.cpp includes.
// Nothing is written to disk, and links are not followed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vegard::sim {

struct TarEntry {
  std::string name;          ///< with its folders
  std::uint64_t offset = 0;  ///< position of its header in the archive
  std::uint64_t bytes = 0;
};

/// True if these first bytes are those of a tar archive.
bool is_tar(std::string_view beginning);

/// An uncompressed archive, so that an entry is read without those before it. All functions throw
/// Error(unreadable_input), naming the file, for an archive that is damaged, truncated or beyond the limits.
class TarFile {
 public:
  static constexpr std::size_t kMaxEntries = 200000;
  static constexpr std::uint64_t kMaxEntryBytes = std::uint64_t{1} << 28;

  /// Opens the file `name`, or `bytes`, which must outlive the object, and reads all headers.
  explicit TarFile(std::string name, std::string_view bytes = {});

  /// Returns the regular files, in the order of the archive.
  const std::vector<TarEntry>& entries() const { return entries_; }
  /// Returns the names of the links to other files, hard and symbolic, which are no entries.
  const std::vector<std::string>& links() const { return links_; }
  std::string read(const TarEntry& entry) const;

 private:
  std::string name_;
  std::string_view bytes_;
  std::vector<TarEntry> entries_;
  std::vector<std::string> links_;
};

}  // namespace vegard::sim
