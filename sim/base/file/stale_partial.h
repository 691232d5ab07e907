// Finds partial outputs of killed processes by their names and distinguishes them from those of living
// processes.
#pragma once

#include <sys/stat.h>

#include <string>
#include <vector>

namespace vegard::sim {

/// A lock that tells all processes, on this machine and on others with the same disk, that a partial output
/// has an owner. On file systems without locks, only the process's number in the name tells it.
class PartialLock {
 public:
  /// Locks and owns `descriptor` of a file or folder; the destructor closes it. -1: no lock.
  explicit PartialLock(int descriptor = -1);
  PartialLock(PartialLock&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  PartialLock& operator=(PartialLock&& other) noexcept;
  ~PartialLock() { release(); }
  void release();

 private:
  int descriptor_ = -1;
};

/// Returns, in the order of their names, the partial outputs of `target` by partial_name(), of one type of
/// file (S_IFREG, S_IFDIR), whose process is gone: their lock is free, and the number in their name is that
/// of no process, or of one that began after they were last written to.
std::vector<std::string> stale_partials(const std::string& target, mode_t type);

/// True if one path is such a partial output; false if partial_name() cannot have made its name.
bool is_stale_partial(const std::string& path, mode_t type);

}  // namespace vegard::sim
