// Partial outputs of killed processes: they are found by name and distinguished from the files of a living
// process.
#pragma once

#include <sys/stat.h>

#include <string>
#include <vector>

namespace vegard::sim {

/// Says to all processes, of this machine and of others that see the same disk, that a partial output has an
/// owner. Where locks are not known nothing is said, and the process's number in the name has to do.
class PartialLock {
 public:
  /// Holds `descriptor` of a file or folder, which must be one, and closes it in the end.
  explicit PartialLock(int descriptor = -1);
  PartialLock(PartialLock&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  PartialLock& operator=(PartialLock&& other) noexcept;
  ~PartialLock() { release(); }
  void release();

 private:
  int descriptor_ = -1;
};

/// Partial outputs beside `target`, of exactly its name as partial_name() makes them and of one kind of file
/// (S_IFREG, S_IFDIR), whose process is gone: none holds their lock, and the number in their name is that of
/// no process, or of one that began after they were last written to. In the order of their names.
std::vector<std::string> stale_partials(const std::string& target, mode_t type);

/// The same question of one path, whose name must be one that partial_name() makes; false if it is not.
bool is_stale_partial(const std::string& path, mode_t type);

}  // namespace vegard::sim
